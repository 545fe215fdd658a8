/* The vertices of a monotone piece's polyline, each a pure function of the piece and the vertex's
 * number; see boundary.h for what they keep. */
#ifndef CS_GEOMETRY_POLYLINE_H
#define CS_GEOMETRY_POLYLINE_H

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
/* y before the vertex was displaced: rising with the number but for rounding. */
double cs_polyline_plain_y(const cs_boundary_set *set, const cs_boundary_piece *piece,
                           uint32_t vertex);

#endif
