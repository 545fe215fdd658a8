/* The polyline of a monotone piece. The sweep walks it instead of the curve.
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
#pragma once

#include "base/wide.h"
#include "model/geometry/boundary.h"
#include "model/geometry/plain.h"

/* Chooses the chords of a piece whose ends and limits in x are set, and which is a single chord so
 * far. Stores the points from which the vertices are made. curve: in the direction of the piece,
 * with weights that are > 0 and within a factor of about 2. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                                               const cs_bezier *curve, cs_boundary_piece *piece);
/* The same for a plain curve of the second or third degree; there must be room for its points. */
void cs_polyline_fit_plain(cs_boundary_set *set, const cs_plain *curve, cs_boundary_piece *piece);
/* Makes room for `count` more points. Errors: NO_MEMORY, LIMIT. */
static inline CELSPAN_CHECKED celspan_status cs_polyline_reserve(celspan_context *context,
                                                                 cs_boundary_set *set,
                                                                 size_t points) {
  if (set->point_count > UINT32_MAX - points)
    return cs_fail(context, CELSPAN_LIMIT, "the frame has more than 4294967295 curve points");
  return CS_ARRAY_RESERVE(context, set->points, set->point_count + points);
}
/* Makes one group, 0..chords / group - 1. If leaps is true, makes the whole leap that contains the
 * group, provided that one arc is near enough to the whole leap. */
void cs_polyline_group(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                       bool leaps, cs_boundary_group *out);
/* A vertex that is neither displaced nor moved: on the curve, at even steps of the parameter. y
 * grows with the number of the vertex, except for rounding. */
celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex);
/* Vertices 1..chords - 1 of a piece, displaced so that the chords between them and the ends of the
 * piece keep the area; they are not moved to whole heights. x, y: room for that number. They may
 * lie a little beyond the ends, and beyond the sides of the frame. */
void cs_polyline_displaced(const cs_boundary_set *set, const cs_boundary_piece *piece, double *x,
                           double *y);

/* Groups of vertices in vector code: all vertices of a group at once (polyline_wide.c).
 *
 *   points at even steps --seats--> parameters --points there--> places beside the curve
 */

#define CS_POLYLINE_ROOM (CS_BOUNDARY_GROUP + 1)

/* The vertices of a group: on the curve, and displaced so that chords keep the area. Elements
 * beyond a short group are not used. */
typedef struct cs_polyline_vertices {
  double x[CS_POLYLINE_ROOM + 1], y[CS_POLYLINE_ROOM + 1];
  /* dx/dy of the chord that begins at the vertex; 0 for a chord without height */
  double slope[CS_POLYLINE_ROOM];
  double on_x[CS_POLYLINE_ROOM], on_y[CS_POLYLINE_ROOM];
  /* The same, with piece->half on the curve too; set only if halves are wanted. */
  double halved_x[CS_POLYLINE_ROOM], halved_y[CS_POLYLINE_ROOM];
  /* no arc can be near the curve at the first vertex, or at the last one */
  bool is_bent_above, is_bent_below;
} cs_polyline_vertices;

/* c: the coefficients of a piece in powers, 4 of x and 4 of y. first: the group's first vertex.
 * stride: the distance from vertex to vertex, more than 1 for the groups of a leap. */
CS_WIDE_DECLARE(void, cs_polyline_powers,
                (const double c[8], const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                 cs_polyline_vertices *out));
/* The same for a piece that is not in powers. points: of its curve. */
CS_WIDE_DECLARE(void, cs_polyline_rational,
                (const cs_hpoint *points, const cs_boundary_piece *piece, uint32_t first,
                 uint32_t stride, cs_polyline_vertices *out));

/* An arc: x + down (mean + curve (down - height)) at y + down. */
typedef struct cs_polyline_arc {
  double x, y, height, mean, curve;
} cs_polyline_arc;

/* Whether an arc for the vertices first..end is too far from the curve at one of these vertices. */
CS_WIDE_DECLARE(bool, cs_polyline_strays,
                (const cs_polyline_arc *arc, const cs_polyline_vertices *vertices, int first,
                 int end));
