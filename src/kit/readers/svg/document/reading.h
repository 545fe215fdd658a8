/* The state of the reading of one file: the document, how much of the limits is used, and what was
 * not drawn.
 *
 *   document --build.c--> items --art.c--> scene values
 *                 |
 *                 +-- shapes.c outlines   servers.c gradients   clips.c clip paths
 *                 |
 *                 +-- patterns.c, filters.c, whose contents come back to build.c
 */
#pragma once

#include "celspan/svg.h"
#include "inside/hash.h"
#include "readers/svg/document/style.h"

#define CS_SVG_DRAWN 1000000 /* the most elements that are drawn, counted again at each `use` */
#define CS_SVG_SELECTOR_TESTS 100000000u /* the most tests of elements against rules, in all */
#define CS_SVG_DRAWINGS 1000 /* the most drawings that are read as images, nested or not */
#define CS_SVG_SKIPPED 10000 /* the most entries; further parts are not reported */

typedef struct cs_svg_skipped {
  uint32_t line;
  size_t number; /* in the order in which the notes are made; set at the end */
  char what[160];
} cs_svg_skipped;

/* The origin of a document: a file, or bytes inside another document. */
typedef struct cs_svg_source {
  const char *name; /* for messages */
  const char *file; /* NULL: bytes */
  const celspan_svg_font *fonts;
  size_t font_count;
  const struct cs_svg_source *outer; /* the drawing that shows this one as an image; NULL: none */
  uint64_t device, number;           /* the identity of the file */
} cs_svg_source;

/* The images that were read, by element and by whether they are coded: an image that `use` shows a
 * thousand times is decoded once. */
typedef struct cs_svg_kept_image {
  celspan_object *object; /* from (0, 0) to its size, owned; NULL: nothing is shown */
  double width, height;
} cs_svg_kept_image;

/* All zero is an empty list. */
typedef struct cs_svg_kept_images {
  cs_hash_table places;
  cs_svg_kept_image *items;
  size_t count, capacity;
} cs_svg_kept_images;

struct cs_svg_place; /* below */
struct cs_svg_clock;

typedef struct cs_svg_reading {
  celspan_context *context;
  cs_svg_document *document;
  const cs_svg_source *source; /* where the document is from */
  celspan_svg *art;            /* the drawing that is made */
  /* Reads a drawing that is an image of this one, and counts against the same limits. *out: new.
   * Errors: INPUT, LIMIT, NO_MEMORY. */
  celspan_status (*read_inner)(struct cs_svg_reading *outer, const cs_svg_source *source,
                               const char *bytes, size_t size, celspan_svg **out);
  /* Draws an element alone, or only its contents. place: the place of its parent; for contents, the
   * place of the element. *out: new, in the units of `place`; NULL: nothing is drawn. Errors:
   * NO_MEMORY, LIMIT, INPUT. */
  celspan_status (*draw)(struct cs_svg_reading *reading, const cs_svg_node *node, bool is_whole,
                         const struct cs_svg_place *place, celspan_object **out);
  void *builder; /* for it */
  /* cs_svg_box_of, which enters the elements inside the one that it measures. */
  celspan_status (*box_of)(struct cs_svg_reading *reading, const cs_svg_node *node,
                           const struct cs_svg_place *place, celspan_box *out, bool *is_there);
  /* Colours keep their codes: in masks, unless the whole drawing is coded. */
  bool is_coded;
  celspan_space space;              /* the space of the drawing and of its parts */
  const struct cs_svg_clock *clock; /* motion.h; NULL: animations are not run */
  double seconds;                   /* the time of its animations; below 0: none of them is run */
  uint64_t tests;                   /* how many tests of selectors are left */
  uint32_t drawn;                   /* elements so far */
  uint32_t depth;                   /* how many elements that are being built contain each other */
  uint32_t drawings;                /* drawings that were read as images so far */
  uint64_t image_bytes;             /* images so far */
  cs_svg_kept_images images;
  /* The drawing includes drawings in other files, or a file that it names could not be shown: the
   * next reading may give another drawing. */
  bool has_other_files;
  bool has_failed; /* the system could not read a file, so the drawing itself may be correct */
  CS_ARRAY(cs_svg_skipped, skipped);
  size_t skipped_count;
} cs_svg_reading;

/* The elements that are being built: a reference to one of them is circular. */
typedef struct cs_svg_open {
  const cs_svg_node *node;
  const struct cs_svg_open *outer;
} cs_svg_open;

/* The element whose fill or stroke other elements inherit: gradients are fitted to it. */
typedef struct cs_svg_context_box {
  celspan_box box;
  celspan_matrix matrix; /* from the element's user units to the drawing's */
  cs_svg_measure measure;
} cs_svg_context_box;

/* The place where an element is drawn, and its style. */
typedef struct cs_svg_place {
  cs_svg_style style;
  celspan_matrix matrix; /* user units to the drawing's */
  cs_svg_measure measure;
  bool is_moved;        /* a `use` shows the element in another place than its own: */
  celspan_matrix moved; /* from the drawing's units at its own place to those at this place */
  const cs_svg_open *open;
  const cs_svg_node *sizes; /* the `use` that shows the next element; NULL: none */
} cs_svg_place;

/* Notes a part that is not drawn. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_skip(cs_svg_reading *reading, const cs_svg_node *node,
                                           const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Counts an element that is drawn, or only measured. Errors: LIMIT for more than CS_SVG_DRAWN. */
CELSPAN_CHECKED celspan_status cs_svg_count_drawn(cs_svg_reading *reading, const cs_svg_node *node);

bool cs_svg_is_open(const cs_svg_open *open, const cs_svg_node *node);

/* The element to which a reference leads; NULL: there is none. */
const cs_svg_node *cs_svg_referred(const cs_svg_reading *reading, cs_svg_reference reference);
/* The element to which the attribute href leads; NULL: none. */
const cs_svg_node *cs_svg_linked(const cs_svg_reading *reading, const cs_svg_node *node);

/* The style that an element has at its place in the file. */
CELSPAN_CHECKED celspan_status cs_svg_style_in_file(cs_svg_reading *reading,
                                                    const cs_svg_node *node, cs_svg_style *out);
/* Moves *place into the element: reads its style and applies its transform. */
CELSPAN_CHECKED celspan_status cs_svg_enter(cs_svg_reading *reading, const cs_svg_node *node,
                                            cs_svg_place *place);
/* A transform about the origin that the attribute transform-origin gives. */
celspan_matrix cs_svg_about_origin(celspan_matrix matrix, const char *origin,
                                   const cs_svg_measure *measure);
/* An element's transform with its origin; the identity if there is no transform. measure: of the
 * viewport, or of the element's own box, which is `box`; else NULL. */
celspan_matrix cs_svg_transform_of(const cs_svg_style *style, const cs_svg_measure *measure,
                                   const celspan_box *box);

/* The paint of a colour: opacity multiplies its alpha. */
celspan_paint cs_svg_paint_of(const cs_svg_reading *reading, const cs_svg_colour *colour,
                              double opacity);

/* False: the element's image was not read yet. out: borrowed from the list. */
bool cs_svg_kept_image_find(const cs_svg_reading *reading, const void *element,
                            cs_svg_kept_image *out);
/* Takes over the object, also after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_kept_image_add(cs_svg_reading *reading, const void *element,
                                                     cs_svg_kept_image image);
void cs_svg_kept_images_finish(cs_svg_kept_images *list, celspan_context *context);
