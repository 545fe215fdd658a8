/* As cs_polyline_vertex, for many vertices at once. */
#include "geometry/polyline.h"

/* The seats of a vertex before the wanted ones, of those, and of one after; the rest is room. */
#define SEATS (CS_BOUNDARY_AHEAD + 4)
static const double offsets[SEATS] = {-1, 0, 1, 2, 3, 4, 5, 6};

/* Functions of their own: structures in the body of a simd loop would keep it from becoming
 * vectors. */
static inline void find_seat(const double c[8], const cs_boundary_piece *piece, double vertex,
                             double *t, double *y, double *whole) {
  cs_polyline_point p = cs_polyline_power(c, vertex * piece->step);
  cs_polyline_seat seat = cs_polyline_seat_of(piece, vertex, &p);
  *t = seat.t;
  *y = seat.y;
  *whole = seat.whole;
}

static inline void place_vertex(const double c[8], const cs_boundary_piece *piece, double vertex,
                                const double *t, double seat_y, double whole, double *x,
                                double *y) {
  cs_polyline_seat seat = {t[1], seat_y, whole};
  cs_polyline_point p = cs_polyline_power(c, seat.t);
  double share = cs_polyline_share(piece, vertex, t[1] - t[0], t[2] - t[1]);
  celspan_point foot = cs_polyline_place(piece, share, &seat, &p);
  *x = foot.x;
  *y = foot.y;
}

void CS_WIDE(cs_polyline_powers)(const double c[8], const cs_boundary_piece *piece,
                                 uint32_t first, cs_boundary_feet *restrict out) {
  const cs_boundary_piece fixed = *piece; /* what is written cannot be the piece */
  const double start = first;
  double t[SEATS], y[SEATS], whole[SEATS];
#pragma omp simd
  for (size_t k = 0; k < SEATS; k++) /* a counter as wide as a double, or lanes are left empty */
    find_seat(c, &fixed, start + offsets[k], &t[k], &y[k], &whole[k]);
#pragma omp simd
  for (size_t k = 0; k < CS_BOUNDARY_AHEAD; k++)
    place_vertex(c, &fixed, start + offsets[k + 1], &t[k], y[k + 1], whole[k + 1], &out->x[k],
                 &out->y[k]);
}

void CS_WIDE(cs_polyline_slopes)(cs_boundary_feet *feet) {
  double rise[CS_BOUNDARY_AHEAD], run[CS_BOUNDARY_AHEAD];
  for (int k = 1; k < CS_BOUNDARY_AHEAD; k++) {
    run[k] = feet->x[k] - feet->x[k - 1];
    rise[k] = feet->y[k] - feet->y[k - 1];
  }
#pragma omp simd
  for (int k = 1; k < CS_BOUNDARY_AHEAD; k++)
    feet->slope[k] = rise[k] > 0 ? run[k] / rise[k] : 0;
}
