/* The vertices of a monotone piece's polyline, each a pure function of the piece and the vertex's
 * number; see boundary.h for what they keep. */
#ifndef CS_GEOMETRY_POLYLINE_H
#define CS_GEOMETRY_POLYLINE_H

#include "base/number.h"
#include "base/wide.h"
#include "geometry/bezier.h"
#include "geometry/boundary.h"

/* No vertex is displaced by more sags than this, but along the curve to a whole height: at most a
 * quarter of a segment and half a pixel in y. cs_polyline_share is at most 0.221 h^2 then, the sag
 * of a segment C'' h^2 / 8. */
#define CS_POLYLINE_LIFT 1.8

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
/* Where the vertex would be if it were neither displaced nor moved: on the curve, in even steps of
 * the parameter. y rises with the number but for rounding. */
celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex);

/* ---- polyline_wide.c */

/* Vertices first..first + CS_BOUNDARY_AHEAD - 1 of a piece in powers as if all were inner ones.
 * c: its coefficients, 4 of x and 4 of y. */
CS_WIDE_DECLARE(void, cs_polyline_powers,
                (const double c[8], const cs_boundary_piece *piece, uint32_t first,
                 cs_boundary_feet *out));
/* The slopes of all segments but the first, from their feet. */
CS_WIDE_DECLARE(void, cs_polyline_slopes, (cs_boundary_feet *feet));

/* A point of a curve with its first and second derivatives by the parameter. */
typedef struct cs_polyline_point {
  double x, y, slope_x, slope_y, bend_x, bend_y;
} cs_polyline_point;

/* Of a piece in powers, 4 coefficients of x and 4 of y. */
static inline cs_polyline_point cs_polyline_power(const double c[8], double t) {
  return (cs_polyline_point){((c[3] * t + c[2]) * t + c[1]) * t + c[0],
                             ((c[7] * t + c[6]) * t + c[5]) * t + c[4],
                             (3 * c[3] * t + 2 * c[2]) * t + c[1],
                             (3 * c[7] * t + 2 * c[6]) * t + c[5],
                             6 * c[3] * t + 2 * c[2],
                             6 * c[7] * t + 2 * c[6]};
}

/* Where a vertex is to be: at a whole height, if the curve has one within a quarter of a segment,
 * so that rows seldom bend; else where it was. */
typedef struct cs_polyline_seat {
  double t;
  double y;     /* the whole height */
  double whole; /* 1: it is to be there; 0: not */
} cs_polyline_seat;

/* p: of the curve at the vertex's step. Selections only, no branches, for vector code. */
static inline cs_polyline_seat cs_polyline_seat_of(const cs_boundary_piece *piece, double vertex,
                                                   const cs_polyline_point *p) {
  const double bias = 0x1.8p52; /* sums with it are whole */
  double t = vertex * piece->step;
  double y = (p->y + bias) - bias, away = y > p->y ? y - p->y : p->y - y;
  double rise = p->slope_y > 0 ? p->slope_y : 1, moved = t + (y - p->y) / rise;
  double inner = vertex > 0 ? (vertex < piece->segments ? 1.0 : 0.0) : 0.0;
  double inside = y > piece->y0 ? (y < piece->y1 ? inner : 0.0) : 0.0;
  double whole = 4 * away <= p->slope_y * piece->step ? inside : 0.0;
  return (cs_polyline_seat){whole > 0 ? moved : t, y, whole};
}

/* Of C'', how far a vertex is displaced: the area between a segment of length h and its curve is
 * |C' x C''| h^3 / 12, and its two ends make up for half of it each; an end of the piece makes up
 * for none. before, after: from the neighbours' parameters to its own. */
static inline double cs_polyline_share(const cs_boundary_piece *piece, double vertex,
                                       double before, double after) {
  double above = (vertex == 1 ? 2.0 : 1.0) * (before * before * before);
  double below = (vertex + 1 == piece->segments ? 2.0 : 1.0) * (after * after * after);
  return (above + below) / (12 * (before + after));
}

/* The displaced vertex. p: of the curve at the seat's parameter, which is one step of Newton's from
 * the height: what is missing to it is gone along the tangent. */
static inline celspan_point cs_polyline_place(const cs_boundary_piece *piece, double share,
                                              const cs_polyline_seat *seat,
                                              const cs_polyline_point *p) {
  double x = p->x - share * p->bend_x, y = p->y - share * p->bend_y;
  double most = CS_POLYLINE_LIFT * piece->sag, lift = cs_number_clamp(p->y - y, -most, most);
  double free_y = cs_number_clamp(p->y - lift, piece->y0, piece->y1);
  double run = seat->whole * p->slope_x / (p->slope_y > 0 ? p->slope_y : 1);
  return (celspan_point){cs_number_clamp(x + (seat->y - y) * run, piece->left, piece->right),
                         seat->whole > 0 ? seat->y : free_y};
}

#endif
