/* The polyline of a monotone piece: what the sweep walks instead of the curve.
 *
 *      *                *  the border of two groups: on the curve (.), or displaced where no arc
 *       \.                 can be near the curve, so that none ends there
 *        \.             o  a vertex inside a group: it is displaced outwards from the curve
 *        \.
 *         .o            group 0: chords from vertex to vertex. Because the vertices are displaced,
 *         .|            the area left of the chords is the area left of the curve.
 *         .o
 *        /.
 *       /.
 *      *
 *       )               group 1: one arc, x as a polynomial of the second degree in y. It has the
 *       )               area of the chords and replaces them where it is near enough to the curve.
 *      *                A group may be two arcs instead, one for each half.
 *     (
 *    (                  groups 2 and 3: a leap, one arc for several groups
 *    (
 *     (
 *      *
 *
 * Every group is a pure function of the piece and the group's number, so a walk can begin anywhere.
 * Vertex k of a piece, 0..chords, is where step k of the curve's parameter ends. Vertices near a
 * whole height are moved along the curve to that height, so that rows have few bends.
 */
#ifndef CS_GEOMETRY_POLYLINE_H
#define CS_GEOMETRY_POLYLINE_H

#include "geometry/boundary.h"
#include "geometry/plain.h"

/* Chooses the chords of a piece whose ends and limits in x are set, and which is one chord until
 * then; stores the points that its vertices are made from. curve: in the direction of the piece, with weights that are > 0 and
 * within a factor of about 2. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                                               const cs_bezier *curve, cs_boundary_piece *piece);
/* The same for a plain curve of the second or third degree; there must be room for its points. */
void cs_polyline_fit_plain(cs_boundary_set *set, const cs_plain *curve, cs_boundary_piece *piece);
/* Room for so many more points. Errors: NO_MEMORY, LIMIT. */
static inline CELSPAN_CHECKED celspan_status cs_polyline_reserve(celspan_context *context,
                                                                 cs_boundary_set *set,
                                                                 size_t points) {
  if (set->point_count > UINT32_MAX - points)
    return cs_fail(context, CELSPAN_LIMIT, "the frame has more than 4294967295 curve points");
  return cs_mem_reserve(context, (void **)&set->points, &set->point_capacity,
                        set->point_count + points, sizeof *set->points);
}
/* Makes group 0..chords / group - 1; or, where leaps is true, the whole leap that the group is in,
 * if one arc is near enough to all of it. */
void cs_polyline_group(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                       bool leaps, cs_boundary_group *out);
/* A vertex that is neither displaced nor moved: on the curve, in even steps of the parameter. y
 * rises with the number, except for rounding. */
celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex);

#endif
