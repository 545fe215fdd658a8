/* find_vertices of polyline.c for a piece in powers, all vertices of a group at once. */
#include "geometry/polyline_wide.h"
#include "geometry/polyline_vertex.h"

#define ARC_TOLERANCE 0.01 /* pixels */

static const double numbers[CS_POLYLINE_ROOM] = {0, 1, 2, 3, 4, 5, 6, 7};

/* The next two are functions because structures in the body of a simd loop would keep the compiler
 * from vectorising it. */
static inline void find_seat(const double c[8], const cs_boundary_piece *piece, double vertex,
                             double k, double *t, double *y, double *whole) {
  cs_polyline_point p = cs_polyline_power(c, vertex * piece->step);
  cs_polyline_seat seat = cs_polyline_seat_of(piece, vertex, k, &p);
  *t = seat.t;
  *y = seat.y;
  *whole = seat.whole;
}

/* t[k]: the parameter of vertex k, y[k] and whole[k]: the rest of its seat. */
static inline void place_vertex(const double c[8], const cs_boundary_piece *piece, size_t k,
                                const double *t, const double *y, const double *whole,
                                cs_polyline_vertices *out) {
  cs_polyline_seat seat = {t[k], y[k], whole[k]};
  cs_polyline_point p = cs_polyline_power(c, t[k]);
  celspan_point on = cs_polyline_place(piece, 0, &seat, &p);
  double share = cs_polyline_share(piece, numbers[k], t[k] - t[k - 1], t[k + 1] - t[k]);
  celspan_point beside = cs_polyline_place(piece, share, &seat, &p);
  out->on_x[k] = on.x;
  out->on_y[k] = on.y;
  out->x[k] = beside.x;
  out->y[k] = beside.y;
}

void CS_WIDE(cs_polyline_powers)(const double c[8], const cs_boundary_piece *piece, uint32_t first,
                                 uint32_t stride, cs_polyline_vertices *restrict out) {
  const cs_boundary_piece fixed = cs_polyline_strided(piece, stride);
  const double start = first, on = stride;
  double t[CS_POLYLINE_ROOM + 2], y[CS_POLYLINE_ROOM], whole[CS_POLYLINE_ROOM];
  t[0] = t[CS_POLYLINE_ROOM + 1] = 0; /* the ends have no neighbour and need none */
#pragma omp simd
  for (size_t k = 0; k < CS_POLYLINE_ROOM; k++) /* a counter as wide as a double fills all lanes */
    find_seat(c, &fixed, start + on * numbers[k], numbers[k], &t[k + 1], &y[k], &whole[k]);
#pragma omp simd
  for (size_t k = 0; k < CS_POLYLINE_ROOM; k++)
    place_vertex(c, &fixed, k, t + 1, y, whole, out);
}

bool CS_WIDE(cs_polyline_strays)(const cs_polyline_arc *arc, const cs_polyline_vertices *vertices,
                                 int first, int end) {
  const cs_polyline_arc a = *arc;
  const double low = first, high = end;
  const double *on_x = vertices->on_x, *on_y = vertices->on_y;
  double strays = 0;
#pragma omp simd reduction(+ : strays)
  for (size_t k = 0; k < CS_POLYLINE_ROOM; k++) {
    double down = on_y[k] - a.y;
    double away = (on_x[k] - a.x) - down * (a.mean + a.curve * (down - a.height));
    double slope = a.mean + a.curve * (2 * down - a.height), steep = slope < 0 ? -slope : slope;
    double across = steep > 1 ? steep : 1; /* a flat arc is nearer than its distance along x */
    double near = (away < 0 ? -away : away) <= ARC_TOLERANCE * across ? 0.0 : 1.0;
    strays += numbers[k] >= low ? (numbers[k] <= high ? near : 0.0) : 0.0;
  }
  return strays > 0;
}
