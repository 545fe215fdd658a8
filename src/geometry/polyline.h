/* The vertices of a monotone piece's polyline, each a pure function of the piece and the vertex's
 * number; see boundary.h for what they keep. */
#ifndef CS_GEOMETRY_POLYLINE_H
#define CS_GEOMETRY_POLYLINE_H

#include "base/wide.h"
#include "geometry/bezier.h"
#include "geometry/boundary.h"

/* Chooses the segments of a piece whose ends and limits in x are set, and stores what its vertices
 * need. curve: runs as the piece does, weights > 0 and within a factor of about 2.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                                               const cs_bezier *curve, cs_boundary_piece *piece);
/* Vertex 0..segments. */
celspan_point cs_polyline_vertex(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                 uint32_t vertex);
/* The feet of the segments first..first + count - 1, at most CS_BOUNDARY_AHEAD; top: where the
 * first of them begins. */
void cs_polyline_feet(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t first,
                      uint32_t count, celspan_point top, cs_boundary_feet *out);
/* y before the vertex was displaced: rising with the number but for rounding. */
double cs_polyline_plain_y(const cs_boundary_set *set, const cs_boundary_piece *piece,
                           uint32_t vertex);

/* ---- polyline_wide.c */

/* Vertices first..first + CS_BOUNDARY_AHEAD - 1 of a piece in powers as if all were inner ones.
 * c: its coefficients, 4 of x and 4 of y. */
CS_WIDE_DECLARE(void, cs_polyline_powers,
                (const double c[8], const cs_boundary_piece *piece, uint32_t first,
                 cs_boundary_feet *out));
/* The slopes of all segments but the first, from their feet. */
CS_WIDE_DECLARE(void, cs_polyline_slopes, (cs_boundary_feet *feet));

/* Inner vertices share among them the displacement C'' h^2 / 12 of every segment; the ends take
 * none, so their neighbours take theirs. Source: prototype of the sweep; the area between a chord
 * and its curve is |C' x C''| h^3 / 12. */
static inline double cs_polyline_share(const cs_boundary_piece *piece, double vertex) {
  double share = 1 + (vertex == 1 ? 0.5 : 0) + (vertex + 1 == piece->segments ? 0.5 : 0);
  return share * (1.0 / 12) * (piece->step * piece->step);
}

#endif
