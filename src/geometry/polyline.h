/* What a monotone piece is walked in, each group a pure function of the piece and the group's
 * number; see boundary.h for what it keeps. Vertex k of a piece, 0..chords, is where step k of its
 * parameter ends; groups begin and end on the curve.
 */
#ifndef CS_GEOMETRY_POLYLINE_H
#define CS_GEOMETRY_POLYLINE_H

#include "base/number.h"
#include "base/wide.h"
#include "geometry/bezier.h"
#include "geometry/boundary.h"

/* No vertex is displaced by more sags than this, but along the curve to a whole height: by about a
 * quarter of a step at most, and half a pixel in y. Its shares are at most 0.29 h^2 in all then;
 * the sag of a chord is C'' h^2 / 8. */
#define CS_POLYLINE_LIFT 2.4

/* Chooses the chords of a piece whose ends and limits in x are set, and stores what its vertices
 * need. curve: runs as the piece does, weights > 0 and within a factor of about 2.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_polyline_fit(celspan_context *context, cs_boundary_set *set,
                                               const cs_bezier *curve, cs_boundary_piece *piece);
/* Group 0..chords / group - 1; or, where leaps is true, the leap that holds it, if one arc does for
 * all of that. */
void cs_polyline_group(const cs_boundary_set *set, const cs_boundary_piece *piece, uint32_t group,
                       bool leaps, cs_boundary_group *out);
/* Where a vertex would be if it were neither displaced nor moved: on the curve, in even steps of
 * the parameter. y rises with the number but for rounding. */
celspan_point cs_polyline_plain(const cs_boundary_set *set, const cs_boundary_piece *piece,
                                uint32_t vertex);

/* ---- for the two ways of making vertices: polyline.c and, many at once, polyline_wide.c */

#define CS_POLYLINE_ROOM (CS_BOUNDARY_GROUP + 1)

/* The vertices of a group: on the curve, and displaced so that chords keep the area. Those beyond a
 * short group do not matter. */
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

/* Whether an arc for the vertices first..end is too far from one of them on the curve. */
CS_WIDE_DECLARE(bool, cs_polyline_strays,
                (const cs_polyline_arc *arc, const cs_polyline_vertices *vertices, int first,
                 int end));

/* A point of a curve with its first and second derivatives by the parameter. */
typedef struct cs_polyline_point {
  double x, y, slope_x, slope_y, bend_x, bend_y;
} cs_polyline_point;

static inline cs_polyline_point cs_polyline_power(const double c[8], double t) {
  return (cs_polyline_point){((c[3] * t + c[2]) * t + c[1]) * t + c[0],
                             ((c[7] * t + c[6]) * t + c[5]) * t + c[4],
                             (3 * c[3] * t + 2 * c[2]) * t + c[1],
                             (3 * c[7] * t + 2 * c[6]) * t + c[5],
                             6 * c[3] * t + 2 * c[2],
                             6 * c[7] * t + 2 * c[6]};
}

/* Where vertex k of a group is to be: at a whole height, if the curve has one within a quarter of a
 * step of a row or more, so that rows seldom bend; else where it was. */
typedef struct cs_polyline_seat {
  double t;
  double y;     /* the whole height */
  double whole; /* 1: it is to be there; 0: not */
} cs_polyline_seat;

/* A piece of which but every so many vertices are made: its chords are longer. */
static inline cs_boundary_piece cs_polyline_strided(const cs_boundary_piece *piece,
                                                    uint32_t stride) {
  cs_boundary_piece strided = *piece;
  strided.sag *= (double)stride * stride;
  return strided;
}

/* How much vertex k of a group is displaced, in h^2 / 12: once, and half as much again for an end
 * beside it that is not. */
static inline double cs_polyline_part(const cs_boundary_piece *piece, double k) {
  const double half = piece->half, group = piece->group;
  double part = 1 +
                (k == 1          ? 0.5
                 : k == half + 1 ? 0.5
                                 : 0.0) +
                (k + 1 == half    ? 0.5
                 : k + 1 == group ? 0.5
                                  : 0.0);
  return k > 0 ? (k < group ? (k == half ? 0.0 : part) : 0.0) : 0.0;
}

/* p: of the curve at the vertex's step. The seat is such that the vertex will be near the height
 * when it has been displaced. Selections only, no branches, for vector code. */
static inline cs_polyline_seat cs_polyline_seat_of(const cs_boundary_piece *piece, double vertex,
                                                   double k, const cs_polyline_point *p) {
  const double bias = 0x1.8p52; /* sums with it are whole */
  double t = vertex * piece->step, y = (p->y + bias) - bias;
  double lift = cs_polyline_part(piece, k) * (1.0 / 12) * (piece->step * piece->step) * p->bend_y;
  double rise = p->slope_y > 0 ? p->slope_y : 1, moved = t + ((y - p->y) + lift) / rise;
  double inner = vertex > 0 ? (vertex < piece->chords ? 1.0 : 0.0) : 0.0;
  double inside = y > piece->y0 ? (y < piece->y1 ? inner : 0.0) : 0.0;
  double away = y > p->y ? y - p->y : p->y - y, rows = p->slope_y * piece->step;
  double whole = rows >= 1 ? (4 * away <= rows ? inside : 0.0) : 0.0;
  return (cs_polyline_seat){whole > 0 ? moved : t, y, whole};
}

/* Of C'', how far vertex k of a group is displaced: the area between a chord of length h and its
 * curve is |C' x C''| h^3 / 12, and each of its ends makes up for half of it; an end of a half for
 * none: its neighbour does. before, after: from the neighbours' parameters to its own. */
static inline double cs_polyline_share(const cs_boundary_piece *piece, double k, double before,
                                       double after) {
  const double half = piece->half, group = piece->group;
  double above = before * before * before, below = after * after * after;
  double all_above = k == 1 ? 2 * above : k == half + 1 ? 2 * above : above;
  double all_below = k + 1 == half ? 2 * below : k + 1 == group ? 2 * below : below;
  double share = (all_above + all_below) / (12 * (before + after));
  return k > 0 ? (k < group ? (k == half ? 0.0 : share) : 0.0) : 0.0;
}

/* A vertex displaced by a share. p: of the curve at the seat's parameter, which is one step of
 * Newton's from the height: what is missing to it is gone along the tangent. */
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
