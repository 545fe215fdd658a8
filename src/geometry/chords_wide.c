#include "geometry/chords.h"

#include "base/number.h"

static inline double held(double x, double least, double most) {
  double above = x > least ? x : least;
  return above < most ? above : most;
}

void CS_WIDE(cs_chords_powers)(const double c[8], const cs_boundary_piece *piece, double chords,
                               double first, cs_chords *restrict out) {
  const double step = 1 / chords, square = step * step;
  const double x0 = c[0], x1 = c[1], x2 = c[2], x3 = c[3];
  const double y0 = c[4], y1 = c[5], y2 = c[6], y3 = c[7];
  const double left = piece->left, right = piece->right, top = piece->y0, foot = piece->y1;
#pragma omp simd
  for (int k = 0; k < CS_CHORDS_BATCH; k++) {
    double vertex = first + (k + 1), t = vertex * step;
    double by = square * cs_chords_share(vertex, chords);
    double x = ((x3 * t + x2) * t + x1) * t + x0, y = ((y3 * t + y2) * t + y1) * t + y0;
    out->x[k + 1] = held(x - by * (6 * x3 * t + 2 * x2), left, right);
    out->y[k + 1] = held(y - by * (6 * y3 * t + 2 * y2), top, foot);
  }
}

void CS_WIDE(cs_chords_slopes)(cs_chords *restrict chords) {
#pragma omp simd
  for (int k = 0; k < CS_CHORDS_BATCH; k++)
    chords->slope[k] = (chords->x[k + 1] - chords->x[k]) / (chords->y[k + 1] - chords->y[k]);
}
