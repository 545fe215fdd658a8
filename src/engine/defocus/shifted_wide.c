/* The taps of a line: each is the same step from all columns of a row. */
#include "engine/defocus/shifted.h"

void CS_WIDE(cs_shifted_add)(const float *upper, const float *lower, const float shares[2],
                             int32_t count, float *sums) {
  const float x = shares[0], y = shares[1];
  int32_t end = 4 * count, i = 0;
  for (; i + CS_WIDE_LANES <= end; i += CS_WIDE_LANES) {
    cs_wide a = cs_wide_load(upper + i), b = cs_wide_load(lower + i);
    a += x * (cs_wide_load(upper + i + 4) - a);
    b += x * (cs_wide_load(lower + i + 4) - b);
    cs_wide_store(sums + i, cs_wide_load(sums + i) + (a + y * (b - a)));
  }
  for (; i < end; i++) {
    float a = upper[i] + x * (upper[i + 4] - upper[i]),
          b = lower[i] + x * (lower[i + 4] - lower[i]);
    sums[i] += a + y * (b - a);
  }
}
