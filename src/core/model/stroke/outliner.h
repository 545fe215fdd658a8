/* The outline of a stroke, made for a view.
 *
 *            right side, forwards                A part that is drawn becomes runs: all that can be
 *     .----->--------->--------->----.           seen of it, as one contour each, up to where it is
 *     |  .......... the line .....>  | cap       hidden. A closed part that is all seen has one
 *     '-----<---------<---------<----'           contour for either side. Folds and some shapes of
 *            right side, backwards               ends are contours of their own.
 *
 * Invariants: the outline is right within the view's tolerance by the nonzero rule, whose windings
 * are 0 or more everywhere. It depends on the stroke and the view alone.
 *
 * Source: the envelope of discs along a curve, as in Farouki and Sverrisson, Approximation of
 * rolling-ball blends for free-form parametric surfaces, 1996; that caps of the discs at both ends
 * make the winding at a point the number of times that a line comes near it follows from counting
 * the extrema of its distance.
 */
#pragma once

#include "model/stroke/stroke.h"

#define CS_STROKE_TOLERANCE 0.004 /* pixels: the tolerance of the sweep is added to it */

/* Appends the outline, in the stroke's own units. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_outline(celspan_context *context, const cs_stroke *stroke,
                                                 const cs_stroke_view *view, cs_outline *outline);
/* The same for callers that need the shape itself: correct within 2^-27 of the stroke's size, and
 * 2^-41 of its distance from the origin. Here dashes take memory, so that LIMIT is also for more of
 * them than CS_STROKE_SHAPED. */
#define CS_STROKE_SHAPED 100000
CELSPAN_CHECKED celspan_status cs_stroke_outline_finely(celspan_context *context,
                                                        const cs_stroke *stroke,
                                                        cs_outline *outline);
/* The box around the stroke under a matrix. *is_seen: whether there is a box, because some of the
 * stroke is visible. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_bounds(celspan_context *context, const cs_stroke *stroke,
                                                const celspan_matrix *matrix, celspan_box *out,
                                                bool *is_seen);
/* How many dashes of a stroke a view shows, or a few more. Counting ends at `most`. */
size_t cs_stroke_count_visible(const cs_stroke *stroke, const cs_stroke_view *view, size_t most);
