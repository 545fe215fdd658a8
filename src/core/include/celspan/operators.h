/* Path operators: objects whose outlines and lines are changed, as animation programs do it.
 * The conventions of celspan/celspan.h hold.
 *
 * Every primitive of the object keeps its place, texture and name, and its contours change: the
 * outline of a shape, which is closed, or the centre line of a stroke, which keeps its width, caps,
 * joins and dashes. Numbers count in the units around the object; where a transform inside it
 * scales unevenly, lengths are scaled by the mean of both. *out: new, or the object with one more
 * reference. Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT also for a stroke whose width varies and for
 * what has no lines, as a rostrum or a blur. */
#ifndef CELSPAN_OPERATORS_H
#define CELSPAN_OPERATORS_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The part of each contour between two shares of its length, clamped to 0..1; if from > to, they
 * change places. offset: a share that is added to both, round and round. together: shares of the
 * length of all contours, one after another. A shape is closed by its chord. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_trim(celspan_context *context,
                                                               celspan_object *object, double from,
                                                               double to, double offset,
                                                               bool together, celspan_object **out);
/* Where two straight sides meet, both end `radius` before the corner, or at their middle, and an
 * arc joins them: of a circle of this radius in a right angle. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_round_corners(celspan_context *context,
                                                                        celspan_object *object,
                                                                        double radius,
                                                                        celspan_object **out);
/* Every piece of a contour gets ridges, 0..10,000, points at a distance of `size` from it, on the
 * two sides in turn; so do its joints. is_smooth: curves instead of straight sides. At most
 * 1,000,000 points. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_zigzag(celspan_context *context,
                                                                 celspan_object *object,
                                                                 double size, size_t ridges,
                                                                 bool is_smooth,
                                                                 celspan_object **out);
/* Above 0, up to 1, it bloats: joints move by this share of the way to the mean of their contour's
 * joints, and control points by the same share away from it. Below 0, down to -1, it puckers. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_pucker(celspan_context *context,
                                                                 celspan_object *object,
                                                                 double amount,
                                                                 celspan_object **out);
/* Points turn about the centre, by `radians` at the centre and evenly less down to 0 at the
 * farthest corner of the object's bounds. centre: NULL: the middle of the bounds. Lines are right
 * within 2^-18 of the object's size. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_twist(celspan_context *context,
                                                                celspan_object *object,
                                                                double radians,
                                                                const celspan_point *centre,
                                                                celspan_object **out);

/* The object grown, or with a distance below 0 shrunk, in the units around it. join: of outer
 * corners, limit: of miters, as for strokes, 1 to 1,000,000. It makes shapes in these units, of the
 * object's shapes and of strokes along their outlines, and no strokes: a closed line grows like the
 * shape inside it, an open one becomes a line around it, and one with dashes, or with a width that
 * varies, grows like a shape. Errors: BAD_ARGUMENT also where it reaches the horizon of a
 * perspective. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_object_offset(celspan_context *context, celspan_object *object, double distance,
                      celspan_stroke_join join, double limit, celspan_object **out);

#ifdef __cplusplus
}
#endif

#endif
