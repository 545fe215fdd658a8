/* One side of a stroke: the pieces of an outline along the right of a line's way.
 *
 * A stroke is the union of what its spokes sweep over. Where the line bends less than the side is
 * away, the tips go forwards, and curves are fitted to their way. Where it bends more sharply, the
 * tips on the inside go backwards, and two spokes that follow each other cross:
 *
 *      a -------*-------> b       the line                         a contour must not go round
 *        .     . .     .          between the line and the         anything in the wrong order, or
 *          . .     . .            intersection the order is that of    parts that lie over each other
 *         . intersection .            a contour; beyond it, it is      cancel. So the side goes by the
 *       .             .           turned round                     intersections, and what is beyond is
 *     tip b         tip a                                          a contour of its own, a fold.
 *
 * Invariants: contours go round in one order, so that their windings never cancel. Curves are within
 * the view's tolerance of the tips' way. The intersections are found by straight steps, and both
 * contours go along the same ones, so they leave nothing between them. Two sides of a curve are
 * halved at the same places, which makes what they share the same to the bit.
 */
#ifndef CS_STROKE_SIDE_H
#define CS_STROKE_SIDE_H

#include "stroke/spoke.h"
#include "stroke/view.h"

typedef struct cs_side {
  celspan_context *context;
  const cs_stroke_view *view;
  cs_outline *outline;
  bool may_hide;  /* some of the stroke may be out of sight: what is has straight sides */
  bool is_turned; /* the line is followed from its end to its beginning */
  bool is_begun;  /* the outline has an open contour, which ends at `at` */
  celspan_point at;
  celspan_point *tips, *intersections; /* of the fold that is under way */
  size_t tip_count, tip_capacity, intersection_count, intersection_capacity;
  cs_outline folds; /* those that are done */
} cs_side;

void cs_side_init(cs_side *side, celspan_context *context, const cs_stroke_view *view,
                  cs_outline *outline);
void cs_side_finish(cs_side *side);

/* All: Errors NO_MEMORY, LIMIT. A straight line to a point; the first one begins a contour. */
CELSPAN_CHECKED celspan_status cs_side_go(cs_side *side, celspan_point to);
/* An arc about a centre by an angle > 0, with the order of a contour, from one direction to
 * another. */
CELSPAN_CHECKED celspan_status cs_side_arc(cs_side *side, const cs_spoke *about, celspan_point from,
                                           celspan_point to, double angle);
/* Along a curve, from the tip of its first spoke to that of its last. */
CELSPAN_CHECKED celspan_status cs_side_follow(cs_side *side, const cs_curve *curve,
                                              const cs_spoke *first, const cs_spoke *last);
/* Ends the contour. */
CELSPAN_CHECKED celspan_status cs_side_close(cs_side *side);
/* Moves the folds into the outline; no contour may be open. */
CELSPAN_CHECKED celspan_status cs_side_add_folds(cs_side *side);

#endif
