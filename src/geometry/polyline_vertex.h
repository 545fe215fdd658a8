/* Vertices of polylines: shared by the two ways of making them, one at a time (polyline.c) and many
 * at once (polyline_wide.c), which must give the same bits.
 *
 *              o k-1         For a chord of length h the area between chord and curve is
 *             / .            |C' x C''| h^3 / 12. Each end of the chord is displaced along -C'' so
 *            /   .           far that it makes up for half of the area: its share.
 *       k   o     .  curve
 *            \   .           The two ends of a half of a group are not displaced at all; there the
 *             \ .            neighbour inside the half is displaced by both shares.
 *              o k+1
 *
 * The seat of a vertex is the parameter of the curve at which it is made. Vertices have even steps
 * of the parameter between them, but a vertex within a quarter of a step from a whole height gets
 * the parameter of that height.
 */
#ifndef CS_GEOMETRY_POLYLINE_VERTEX_H
#define CS_GEOMETRY_POLYLINE_VERTEX_H

#include "base/number.h"
#include "geometry/boundary.h"

/* No vertex is displaced outwards by more sags than this; the sag of a chord is C'' h^2 / 8. Moving
 * a vertex along the curve to a whole height adds to that: by at most about a quarter of a step,
 * and half a pixel in y. The shares of a vertex are then at most 0.29 h^2. */
#define CS_POLYLINE_LIFT 2.4

/* A point of a curve, with its first and second derivatives by the parameter. */
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

/* The seat of a vertex. Steps lower than a row have no whole heights to move to. */
typedef struct cs_polyline_seat {
  double t;
  double y;     /* the whole height */
  double whole; /* 1: the vertex moves there; 0: it does not */
} cs_polyline_seat;

/* A piece of which only every stride-th vertex is made: its chords are longer. */
static inline cs_boundary_piece cs_polyline_strided(const cs_boundary_piece *piece,
                                                    uint32_t stride) {
  cs_boundary_piece strided = *piece;
  strided.sag *= (double)stride * stride;
  return strided;
}

/* The displacement of vertex k of a group in units of C'' h^2 / 12, if all steps have length h: 1,
 * and 1/2 more for every neighbour that is not displaced. */
static inline double cs_polyline_even_share(const cs_boundary_piece *piece, double k) {
  const double half = piece->half, group = piece->group;
  double share = 1 +
                 (k == 1          ? 0.5
                  : k == half + 1 ? 0.5
                                  : 0.0) +
                 (k + 1 == half    ? 0.5
                  : k + 1 == group ? 0.5
                                   : 0.0);
  return k > 0 ? (k < group ? (k == half ? 0.0 : share) : 0.0) : 0.0;
}

/* p: the curve at the vertex's even parameter. The seat is chosen so that the vertex lies near the
 * height after it has been displaced. No branches, for vector code. */
static inline cs_polyline_seat cs_polyline_seat_of(const cs_boundary_piece *piece, double vertex,
                                                   double k, const cs_polyline_point *p) {
  const double bias = 0x1.8p52; /* a sum with this is a whole number */
  double t = vertex * piece->step, y = (p->y + bias) - bias;
  double lift =
      cs_polyline_even_share(piece, k) * (1.0 / 12) * (piece->step * piece->step) * p->bend_y;
  double rise = p->slope_y > 0 ? p->slope_y : 1, moved = t + ((y - p->y) + lift) / rise;
  double inner = vertex > 0 ? (vertex < piece->chords ? 1.0 : 0.0) : 0.0;
  double inside = y > piece->y0 ? (y < piece->y1 ? inner : 0.0) : 0.0;
  double away = y > p->y ? y - p->y : p->y - y, rows = p->slope_y * piece->step;
  double whole = rows >= 1 ? (4 * away <= rows ? inside : 0.0) : 0.0;
  return (cs_polyline_seat){whole > 0 ? moved : t, y, whole};
}

/* The displacement of vertex k of a group, in units of C''. before, after: the distances of its
 * parameter from those of its neighbours. */
static inline double cs_polyline_share(const cs_boundary_piece *piece, double k, double before,
                                       double after) {
  const double half = piece->half, group = piece->group;
  double above = before * before * before, below = after * after * after;
  double all_above = k == 1 ? 2 * above : k == half + 1 ? 2 * above : above;
  double all_below = k + 1 == half ? 2 * below : k + 1 == group ? 2 * below : below;
  double share = (all_above + all_below) / (12 * (before + after));
  return k > 0 ? (k < group ? (k == half ? 0.0 : share) : 0.0) : 0.0;
}

/* A vertex displaced by its share. p: the curve at the parameter of the seat. A seat at a whole
 * height was found by one step of Newton's method, so the curve is not quite at the height there;
 * the vertex is moved along the tangent by the rest. */
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
