/* The view of a stroke: where its own units are seen, and how exactly.
 *
 *        frame            In the frame an outline may be wrong by `tolerance` pixels. What is d
 *     +---------+         pixels outside of it may be wrong by d / 4: it cannot come in.
 *     |         |   d
 *     |         |<------> *
 *     +---------+
 *
 * Of a frame some rows may be asked for: what lies wholly above or below them is left out, and what
 * does not is the same, to the bit, as without that.
 */
#ifndef CS_STROKE_VIEW_H
#define CS_STROKE_VIEW_H

#include "geometry/boundary.h"

typedef struct cs_stroke_view {
  celspan_matrix matrix; /* own units to pixels; faces the viewer (geometry/matrix.h) */
  cs_boundary_frame frame;
  double tolerance;   /* pixels */
  double top, bottom; /* of the rows that are asked for, pixels */
} cs_stroke_view;

/* How far from its place, in pixels, what is inside a box may be drawn. */
double cs_stroke_view_allowance(const cs_stroke_view *view, const celspan_box *box);
/* The distance in pixels between two points that ought to be one. 0 behind the horizon. */
double cs_stroke_view_error(const cs_stroke_view *view, celspan_point is, celspan_point ought);
/* Whether nothing in the box can be seen on the rows that are asked for. */
bool cs_stroke_view_hides(const cs_stroke_view *view, const celspan_box *box);
/* Whether everything in the box is in the frame, and on the rows that are asked for. */
bool cs_stroke_view_holds(const cs_stroke_view *view, const celspan_box *box);
/* Whether the box is much larger than the frame, so that it is worth while to look at parts of it. */
bool cs_stroke_view_is_exceeded(const cs_stroke_view *view, const celspan_box *box);

#endif
