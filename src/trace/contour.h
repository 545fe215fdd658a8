/* The outline of a stroke as lines and cubics, for formats that have no strokes of varying width.
 *
 *      .--------------.        points of both sides and around both ends, close together, fitted as
 *     (   - - - - - -  )       an edge is
 *      '--------------'
 *
 * INVARIANT: within 1/20 pixel of the outline that the stroke is drawn with, but where the inner side
 * of a bend runs back on itself, which is inside of it.
 */
#ifndef CS_TRACE_CONTOUR_H
#define CS_TRACE_CONTOUR_H

#include "trace/fit.h"
#include "trace/result.h"

/* The sides of one that is closed are two contours. */
typedef struct cs_contours {
  celspan_point start[2];
  cs_pieces pieces[2];
  size_t count;
} cs_contours;

/* Errors: NO_MEMORY. To be finished, whatever happens. */
CELSPAN_CHECKED celspan_status cs_contours_make(celspan_context *context, const cs_shape *shape,
                                                cs_contours *out);
void cs_contours_finish(celspan_context *context, cs_contours *contours);

#endif
