/* Numbered random cases: the same numbers for the same seed everywhere (splitmix64). Never draw two
 * random numbers among the arguments of one call, or the operands of one sum, because C does not
 * define their order (draws.lua checks this). */
#pragma once

#include <stdint.h>

#include "celspan/celspan.h"

typedef struct test_random {
  uint64_t state;
} test_random;

static inline uint64_t random_bits(test_random *random) {
  uint64_t z = (random->state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static inline double random_between(test_random *random, double low, double high) {
  return low + (high - low) * ((double)(random_bits(random) >> 11) * 0x1p-53);
}

/* In [x0, x1) x [y0, y1). */
static inline celspan_point random_point(test_random *random, double x0, double x1, double y0,
                                         double y1) {
  double x = random_between(random, x0, x1), y = random_between(random, y0, y1);
  return (celspan_point){x, y};
}

/* In [0, 1), a multiple of 2^-24. */
static inline float random_unit(test_random *random) {
  return (float)(random_bits(random) >> 40) * 0x1p-24f;
}

/* 0 .. count - 1 */
static inline int random_below(test_random *random, int count) {
  return (int)(random_bits(random) % (uint64_t)count);
}
