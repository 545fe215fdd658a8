/* How far something extends along a row. */
#pragma once

#include <math.h>

typedef struct cs_extent {
  double low, high; /* x; low > high: nowhere */
} cs_extent;

static inline cs_extent cs_extent_nowhere(void) { return (cs_extent){INFINITY, -INFINITY}; }

static inline cs_extent cs_extent_join(cs_extent a, cs_extent b) {
  return (cs_extent){a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}

static inline void cs_extent_add(cs_extent *extent, double x) {
  extent->low = x < extent->low ? x : extent->low;
  extent->high = x > extent->high ? x : extent->high;
}

/* How much of an extent lies in 0..width. */
static inline double cs_extent_shown(cs_extent extent, double width) {
  return fmin(fmax(extent.high, 0), width) - fmax(fmin(extent.low, width), 0);
}

static inline int cs_extent_has(cs_extent extent, double x) {
  return x >= extent.low && x <= extent.high;
}
