#include "sweep/advance.h"

bool CS_WIDE(cs_advance_to)(const cs_segments *segments, size_t count, double y, double *x_next) {
  const double *x0 = segments->x0, *y0 = segments->y0;
  const double *slope = segments->slope, *y1 = segments->y1;
  int64_t ended = 0;
#pragma omp simd reduction(+ : ended)
  for (size_t i = 0; i < count; i++) {
    x_next[i] = x0[i] + (y - y0[i]) * slope[i];
    ended += y1[i] <= y;
  }
  return ended > 0;
}

bool CS_WIDE(cs_advance_rises)(const double *x, size_t count) {
  int64_t falls = 0;
#pragma omp simd reduction(+ : falls)
  for (size_t i = 1; i < count; i++)
    falls += !(x[i - 1] < x[i]);
  return falls == 0;
}
