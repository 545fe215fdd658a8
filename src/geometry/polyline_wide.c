/* As at_power and cs_polyline_vertex of polyline.c, step by step, for many vertices at once. */
#include "geometry/polyline.h"

#include "base/number.h"

void CS_WIDE(cs_polyline_powers)(const double c[8], const cs_boundary_piece *piece,
                                 uint32_t first, cs_boundary_feet *out) {
  const double step = piece->step, overhang = piece->overhang;
  const double left = piece->left, right = piece->right, top = piece->y0, foot = piece->y1;
#pragma omp simd
  for (int k = 0; k < CS_BOUNDARY_AHEAD; k++) {
    double vertex = (double)first + k, t = vertex * step;
    double share = cs_polyline_share(piece, vertex);
    double x = ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
    double y = ((c[7] * t + c[6]) * t + c[5]) * t + c[4];
    double lift = cs_number_clamp(share * (6 * c[7] * t + 2 * c[6]), -overhang, overhang);
    out->x[k] = cs_number_clamp(x - share * (6 * c[3] * t + 2 * c[2]), left, right);
    out->y[k] = cs_number_clamp(y - lift, top, foot);
  }
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
