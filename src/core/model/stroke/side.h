/* One side of a stroke: the pieces of an outline along the right of a line's way.
 *
 * A stroke is the union of the areas that its spokes sweep over. Where the line bends less than the
 * side is away, the tips go forwards. Where it bends more sharply, the tips on the inside go
 * backwards, for a spoke turns about its pivot, and the part beyond the pivot moves the other way:
 *
 *         a --------> b     the line    A contour must not go round anything in the wrong
 *          \        /                   order, or parts that lie over each other cancel. So the
 *           \      /                    side goes from tip a along spoke a to its pivot, then
 *            '.  .'   the way of the    along the way of the pivots, then along spoke b out to
 *              \/     pivots            tip b. The part beyond the pivots is a contour of its
 *              /\                       own, a fold: from tip b along the tips back to tip a, then
 *            .'  '.                     as the side goes, to tip b. The way of the pivots is in
 *    tip b  *--<---* tip a              both, to the bit: 2 or 0 windings are added by crossing it.
 *
 * Invariant: contours go round in one order, so that their windings never cancel.
 */
#pragma once

#include "model/stroke/spoke.h"
#include "model/stroke/stroke.h"

typedef struct cs_side {
  celspan_context *context;
  const cs_stroke_view *view;
  cs_outline *outline;
  bool may_hide;  /* some of the stroke may be out of sight: the hidden parts have straight sides */
  bool is_turned; /* the line is followed from its end to its beginning */
  bool is_begun;  /* the outline has an open contour, which ends at `at` */
  celspan_point at;
  cs_outline tips; /* the tips of the current fold: an open contour in their direction; or empty */
  size_t fold_begin; /* the piece of the outline at which the side left the first tip */
  cs_outline folds;  /* the finished folds */
} cs_side;

void cs_side_init(cs_side *side, celspan_context *context, const cs_stroke_view *view,
                  cs_outline *outline);
void cs_side_finish(cs_side *side);

/* The allowed error in pixels near some points: in their box, enlarged on every side by a share of
 * its size. */
double cs_side_allowance(const cs_side *side, const celspan_point *points, int count, double share);
celspan_point cs_side_on_cubic(const celspan_point p[4], double t);

/* All functions: Errors NO_MEMORY, LIMIT. A straight line to a point; the first line begins a
 * contour. */
CELSPAN_CHECKED celspan_status cs_side_go(cs_side *side, celspan_point to);
/* A cubic that begins where the side ends. */
CELSPAN_CHECKED celspan_status cs_side_curve(cs_side *side, const celspan_point p[4]);
/* An arc about a centre by an angle > 0, with the order of a contour, from one direction to
 * another. */
CELSPAN_CHECKED celspan_status cs_side_arc(cs_side *side, const cs_spoke *about, celspan_point from,
                                           celspan_point to, double angle);
/* A part of a fold: the tips go backwards on one cubic, while the pivots move on another one. Parts
 * that continue each other from tip to tip make one fold. */
CELSPAN_CHECKED celspan_status cs_side_fold(cs_side *side, const celspan_point tips[4],
                                            const celspan_point pivots[4]);
/* A fold about one pivot, the centre of `to`, by an angle > 0 against the order of a contour. */
CELSPAN_CHECKED celspan_status cs_side_fold_arc(cs_side *side, const cs_spoke *from,
                                                const cs_spoke *to, double angle);
/* Ends the contour. */
CELSPAN_CHECKED celspan_status cs_side_close(cs_side *side);
/* Moves the folds into the outline; no contour may be open. */
CELSPAN_CHECKED celspan_status cs_side_add_folds(cs_side *side);

/* Corners, caps and other places where the side of a stroke changes its direction at a point.
 *
 *     round             bevel             miter              the inside, and cuts
 *
 *        .---.          o-----o               o tip
 *      .'     '.       /       \            .' '.             o         o
 *     o         o     o  chord  o          o     o              \     /
 *      \       /       \       /            \   /                 \ /
 *       centre          centre              centre                centre
 *
 * A round shape fills the disc between two spokes, which is where the disc of that place lies
 * outside of all its neighbours; a smooth place where the radius bends is treated so too. The other
 * shapes have the width of their place: if the spokes lean, the space between them and the normals
 * is filled as at the end of a stroke that has butt caps.
 *
 *   butt end     o tip           the width falls from here:       tip o    the width grows: the
 *                | \             the disc up to the normal            |    end is straight from
 *     the line's |  o                                                 |    tip to tip
 *     end        *--->                                            <---*
 */

/* From the tip where the side arrives to the tip where it leaves, at one place. Errors: NO_MEMORY,
 * LIMIT. */
CELSPAN_CHECKED celspan_status cs_corner_turn(cs_side *side, const cs_stroke *stroke,
                                              const cs_spoke *in, const cs_spoke *out);
/* From the tip on the right of a line's end to the tip on its left. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_corner_cap(cs_side *side, const cs_stroke *stroke,
                                             const cs_spoke *end);
/* The same for an end where the line is only cut. */
CELSPAN_CHECKED celspan_status cs_corner_cut(cs_side *side, const cs_spoke *end);
/* Separate contours for parts that do not lie along the side: the straight ends of both lines at a
 * corner, and a square cap in front of a straight end. */
CELSPAN_CHECKED celspan_status cs_corner_turn_more(cs_side *side, const cs_stroke *stroke,
                                                   const cs_spoke *in, const cs_spoke *out);
CELSPAN_CHECKED celspan_status cs_corner_cap_more(cs_side *side, const cs_stroke *stroke,
                                                  const cs_spoke *end);
/* A line of no length. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_corner_dot(cs_side *side, const cs_stroke *stroke,
                                             const cs_spoke *place);

/* ---- follow.c */

/* Appends the side along a curve, from the tip of its first spoke to the tip of its last spoke.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_follow_curve(cs_side *side, const cs_curve *curve,
                                               const cs_spoke *first, const cs_spoke *last);
