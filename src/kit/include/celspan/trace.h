/* Tracing: shapes from a picture.
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_TRACE_H
#define CELSPAN_TRACE_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A picture as shapes: the areas of a flat-coloured drawing or of scanned line art as closed paths
 * of lines and cubics, one for each area that hangs together, or its lines as strokes. The border
 * between two areas is one curve, used by both of them in opposite directions, so that nothing
 * shows between them, at any size. Immutable and counted like a scene value.
 *
 * Limits: a picture of 268,435,456 pixels, 1,048,576 shapes. */
typedef struct celspan_trace celspan_trace;

typedef struct celspan_trace_desc {
  size_t struct_size;
  /* The picture that is traced; its sampling, use, wrap and box do not matter. Borrowed. */
  const celspan_picture_desc *picture;
  /* the number of colours to find in the picture; fewer are found if it has no more; 1..64; 2 */
  int32_t colours;
  const unsigned char *codes; /* or the given colours: `colours` times 3 bytes, sRGB; borrowed */
  /* How far curves may leave the edges: 1 stands for 0.15 pixels; 0..16; 1. 0: they follow the
   * sides of the pixels. In a picture without mixed pixels, an edge is only known to half a pixel,
   * which is added. */
  double smooth;
  int32_t speckle; /* areas of at most this many pixels go to their neighbours; 2 */
  /* strokes along the middle of the lines that are drawn on the ground, instead of areas */
  bool lines;
} celspan_trace_desc;

CELSPAN_DESCRIPTION(celspan_trace_desc)
#define CELSPAN_TRACE_DESC (celspan_trace_desc_initial())

typedef struct celspan_trace_shape {
  size_t struct_size;
  celspan_object *object;      /* borrowed from the tracing, as all pointers here */
  unsigned char colour[3];     /* sRGB; the object is painted with it, opaque */
  int32_t x, y;                /* a pixel of it */
  double area;                 /* in pixels of the picture */
  const char *data;            /* the data of a closed path; NULL: a stroke */
  const celspan_point *points; /* the points of a stroke: of a spline of degree 3 */
  const double *widths;        /* one for each point */
  size_t point_count;
  bool is_closed; /* the stroke */
} celspan_trace_shape;

CELSPAN_RESULT(celspan_trace_shape)
#define CELSPAN_TRACE_SHAPE (celspan_trace_shape_initial())

/* Where alpha is below one half there is nothing. Shapes are in pixels of the picture, from its top
 * left corner; their coordinates are whole thousandths.
 * desc: borrowed      out: new
 * Errors: INPUT for a picture that is missing or cannot be read; LIMIT; NO_MEMORY; BAD_ARGUMENT for
 * the description; CALLBACK of a surface. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_trace_create(celspan_context *context,
                                                                const celspan_trace_desc *desc,
                                                                celspan_trace **out);
CELSPAN_API celspan_trace *celspan_trace_ref(celspan_trace *trace);
CELSPAN_API void celspan_trace_unref(celspan_trace *trace);
/* The size of its picture in pixels. Shared read, like all functions below. */
CELSPAN_API void celspan_trace_size(const celspan_trace *trace, int32_t *width, int32_t *height);
/* The union of all shapes; borrowed. */
CELSPAN_API celspan_object *celspan_trace_object(const celspan_trace *trace);
/* Areas in descending order of size, strokes in descending order of length. _at: false, and *out
 * does not change, if there is no such shape, or *out has no size. */
CELSPAN_API size_t celspan_trace_shape_count(const celspan_trace *trace);
CELSPAN_API bool celspan_trace_shape_at(const celspan_trace *trace, size_t index,
                                        celspan_trace_shape *out);
/* Writes an SVG drawing (.svg) or a script (.lua: a film of one frame, and a module with the
 * shapes), whole or not at all. Errors: OUTPUT; BAD_ARGUMENT for another ending; NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_trace_write(celspan_context *context,
                                                               const celspan_trace *trace,
                                                               const char *path);

#ifdef __cplusplus
}
#endif
#endif
