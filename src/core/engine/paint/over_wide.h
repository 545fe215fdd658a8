/* Code shared by the loops over pixels of over_row and over_bare: pixels of four floats, a register
 * of them at a time. For files that are compiled once for every set of instructions (base/wide.h).
 */
#pragma once

#include <string.h>

#include "base/wide.h"

#define CS_OVER_WIDE_PIXELS (CS_WIDE_LANES / 4) /* in a register */

/* One pixel's four floats, in every pixel of a register. */
static inline cs_wide cs_over_wide_all(const float v[4]) {
  const cs_wide wide = CS_WIDE_PIXEL(v[0], v[1], v[2], v[3]);
  return wide;
}

/* The mean of the three channels of each pixel, in all its lanes, as cs_over_mean. */
static inline cs_wide cs_over_wide_mean(cs_wide t) {
  cs_wide first = CS_WIDE_SPREAD(t, 0), second = CS_WIDE_SPREAD(t, 1), third = CS_WIDE_SPREAD(t, 2);
  return first + ((second - first) + (third - first)) * (1.0f / 3);
}

/* Stores the pixels of a register at pixel i and after it, in a row of `count` pixels. */
static inline void cs_over_wide_put(cs_wide colour, int32_t i, int32_t count, float (*rgba)[4]) {
  if (i + CS_OVER_WIDE_PIXELS <= count)
    cs_wide_store(rgba[i], colour);
  else
    memcpy(rgba[i], &colour, (size_t)(count - i) * sizeof *rgba);
}

/* Sets the pixels after the last one of a row to 0, as far as its last register goes: nobody has
 * written them, and a register may be asked whether any of its pixels has a property. */
static inline void cs_over_wide_clear_rest(float (*row)[4], int32_t count) {
  for (int32_t i = count; i % CS_OVER_WIDE_PIXELS != 0; i++)
    memset(row[i], 0, sizeof *row);
}
