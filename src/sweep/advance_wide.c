#include "sweep/advance.h"

bool CS_WIDE(cs_advance_to)(const cs_segments *segments, size_t count, double y, double *x_next,
                            bool *rises) {
  const double *x0 = segments->x0, *y0 = segments->y0;
  const double *slope = segments->slope, *curve = segments->curve, *y1 = segments->y1;
  int64_t ended = 0, falls = 0, whole = (int64_t)cs_advance_whole(count), there = (int64_t)count;
#pragma omp simd reduction(+ : ended, falls)
  for (int64_t i = 0; i < whole; i++) {
    double down = y - y0[i], down_after = y - y0[i + 1];
    double x = x0[i] + down * (slope[i] + down * curve[i]);
    double after = x0[i + 1] + down_after * (slope[i + 1] + down_after * curve[i + 1]);
    x_next[i] = x; /* not to be read as the x after another: it may not be stored yet */
    ended += (y1[i] <= y) & (i < there);
    falls += !(x < after) & (i + 1 < there);
  }
  *rises = falls == 0;
  return ended > 0;
}

bool CS_WIDE(cs_advance_rises)(const double *x, size_t count) {
  if (count < 2)
    return true;
  int64_t falls = 0, pairs = (int64_t)count - 1, whole = (int64_t)cs_advance_whole(count - 1);
#pragma omp simd reduction(+ : falls)
  for (int64_t i = 0; i < whole; i++)
    falls += !(x[i] < x[i + 1]) & (i < pairs);
  return falls == 0;
}
