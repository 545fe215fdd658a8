/* Groups of vertices in vector code: all vertices of a group at once (polyline_wide.c).
 *
 * Invariant: the same bits as one vertex at a time (find_vertices of polyline.c), because both use
 * the formulas of polyline_vertex.h.
 */
#ifndef CS_GEOMETRY_POLYLINE_WIDE_H
#define CS_GEOMETRY_POLYLINE_WIDE_H

#include "base/wide.h"
#include "geometry/boundary.h"

#define CS_POLYLINE_ROOM (CS_BOUNDARY_GROUP + 1)

/* The vertices of a group: on the curve, and displaced so that chords keep the area. Elements
 * beyond a short group are not used. */
typedef struct cs_polyline_vertices {
  double on_x[CS_POLYLINE_ROOM], on_y[CS_POLYLINE_ROOM];
  double x[CS_POLYLINE_ROOM], y[CS_POLYLINE_ROOM];
} cs_polyline_vertices;

/* c: the coefficients of a piece in powers, 4 of x and 4 of y. first: the group's first vertex.
 * stride: from vertex to vertex, more than 1 for the groups of a leap. */
CS_WIDE_DECLARE(void, cs_polyline_powers,
                (const double c[8], const cs_boundary_piece *piece, uint32_t first, uint32_t stride,
                 cs_polyline_vertices *out));

/* An arc: x + down (mean + curve (down - height)) at y + down. */
typedef struct cs_polyline_arc {
  double x, y, height, mean, curve;
} cs_polyline_arc;

/* Whether an arc for the vertices first..end is too far from one of their places on the curve. */
CS_WIDE_DECLARE(bool, cs_polyline_strays,
                (const cs_polyline_arc *arc, const cs_polyline_vertices *vertices, int first,
                 int end));

#endif
