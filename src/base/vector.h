/* Four floats at once. The compiler's vector types: every lane is plain IEEE arithmetic, so the bits
 * do not depend on the instruction set. */
#ifndef CS_BASE_VECTOR_H
#define CS_BASE_VECTOR_H

#include <string.h>

typedef float cs_v4 __attribute__((vector_size(16)));

static inline cs_v4 cs_v4_all(float x) { return (cs_v4){x, x, x, x}; }

static inline cs_v4 cs_v4_load(const float *from) {
  cs_v4 v;
  memcpy(&v, from, sizeof v);
  return v;
}

static inline void cs_v4_store(float *to, cs_v4 v) { memcpy(to, &v, sizeof v); }

/* Lane by lane the greater, the lesser; b where a is not a number. */
static inline cs_v4 cs_v4_max(cs_v4 a, cs_v4 b) {
  typedef int lanes __attribute__((vector_size(16)));
  lanes use_a = a > b;
  return (cs_v4)(((lanes)a & use_a) | ((lanes)b & ~use_a));
}

static inline cs_v4 cs_v4_min(cs_v4 a, cs_v4 b) {
  typedef int lanes __attribute__((vector_size(16)));
  lanes use_a = a < b;
  return (cs_v4)(((lanes)a & use_a) | ((lanes)b & ~use_a));
}

/* Whether a lane of a is greater than that of b. */
static inline int cs_v4_any_above(cs_v4 a, cs_v4 b) {
  typedef long long words __attribute__((vector_size(16)));
  words above = (words)(a > b);
  return (above[0] | above[1]) != 0;
}

/* Whether all 128 bits agree: minus zero differs from zero. */
static inline int cs_v4_same(cs_v4 a, cs_v4 b) {
  typedef long long words __attribute__((vector_size(16)));
  words differ = (words)a ^ (words)b;
  return (differ[0] | differ[1]) == 0;
}

#endif
