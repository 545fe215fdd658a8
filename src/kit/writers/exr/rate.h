/* The rate of a film as a fraction, for the attribute framesPerSecond: OpenImageIO's writer and the
 * core's own write the same. C and C++. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* false: the rate is 0 or invalid. 23.976, 29.97 and 59.94 are n * 1000 / 1001. */
static inline bool cs_rate_fraction(double rate, int32_t out[2]) {
  if (!(rate > 0 && rate < 1e5))
    return false;
  double whole = (double)(int64_t)(rate + 0.5), drop = (double)(int64_t)(rate * 1.001 + 0.5);
  double away = rate * 1.001 - drop;
  bool is_whole = rate == whole, is_drop = away > -0.002 && away < 0.002;
  out[0] = is_whole ? (int32_t)whole : (int32_t)(is_drop ? drop * 1000 : rate * 1000 + 0.5);
  out[1] = is_whole ? 1 : is_drop ? 1001 : 1000;
  return true;
}
