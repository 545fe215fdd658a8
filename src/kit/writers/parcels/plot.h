/* Frames as drawings, SVG or PDF, of what can be seen of them.
 *
 *     under: a stroke of the colour of the thicker fill along each border between opaque fills
 *     over:  the fills, from the thickest to the thinnest
 *
 * Renderers that mix edges one after the other would let the page shine through at a border, where
 * two areas cover parts of a pixel. Strokes lie under all areas, so that they show only there.
 */
#pragma once

#include "celspan/plane.h"
#include "inside/context.h"

typedef enum cs_flat {
  CS_FLAT_OVER,   /* there are strokes under the areas */
  CS_FLAT_REGIONS /* there are only areas, which do not overlap */
} cs_flat;

/* What a drawing has unless another is asked for. */
enum { CS_PLOT_PRECISION = 3, CS_PLOT_SCALE = 2 };

typedef struct cs_plot_desc {
  cs_flat flat;
  int32_t precision;     /* digits after the point, 0 to 9; PDF has a grid of its own */
  double scale;          /* pixels for each film unit of what becomes a picture */
  int32_t width, height; /* the size in pixels that the drawing is for; 0: the film's */
  const char *title;     /* the title of the film; NULL: none; borrowed until the file ends */
  bool is_pdf;           /* instead of SVG; a pixel of the size is then a point */
} cs_plot_desc;

/* What a drawing became. */
typedef struct cs_plot_facts {
  size_t areas, curves, pictures;
  int32_t picture_width, picture_height; /* the largest picture */
  bool is_picture;                       /* the plane is one picture; the context says why */
} cs_plot_facts;

/* A file that is being written: SVG of one page, or PDF of any number of them. */
typedef struct cs_plot cs_plot;

/* *out: NULL if it fails. Errors: those of a file; for PDF OUTPUT if its module is missing. */
CELSPAN_CHECKED celspan_status cs_plot_begin(celspan_context *context, const char *path,
                                             const cs_plot_desc *desc, cs_plot **out);
/* Adds a frame, whole: its size and crop are ignored. One that no plane can keep becomes a picture,
 * which alone has its antialiasing. Errors: those of rendering and of writing a file; LIMIT for
 * more borders than CS_PARCEL_ARCS, and for a picture or a page that is too large. */
CELSPAN_CHECKED celspan_status cs_plot_add_frame(cs_plot *plot, const celspan_frame_desc *frame,
                                                 cs_plot_facts *facts);
/* Adds a plane in the same way; one that is a sum becomes a picture. Errors: BAD_ARGUMENT for one
 * whose borders do not meet. */
CELSPAN_CHECKED celspan_status cs_plot_add_plane(cs_plot *plot, const celspan_plane *plane,
                                                 cs_plot_facts *facts);
/* Ends the file: it gets its name if `outcome` is OK. Returns the first failure. */
CELSPAN_CHECKED celspan_status cs_plot_end(cs_plot *plot, celspan_status outcome);

enum { CS_PLOT_SAID = CS_ERROR_SIZE + 256 };
/* Writes a sentence on what became a picture. path: of the file. context: that of the facts. false:
 * nothing did. */
bool cs_plot_say(const celspan_context *context, const char *path, const cs_plot_desc *desc,
                 const cs_plot_facts *facts, char text[CS_PLOT_SAID]);
