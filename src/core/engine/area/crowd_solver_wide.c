/* Sums over pairs of lines, eight at a time: the same number on all machines. */
#include "engine/area/crowd_solver.h"

typedef float eight __attribute__((vector_size(4 * CS_CROWD_SUMS)));
typedef int32_t eight_int __attribute__((vector_size(4 * CS_CROWD_SUMS)));

static inline void load(eight *to, const float *from) { memcpy(to, from, sizeof *to); }

static inline void most(eight *a, const eight *b) {
  eight_int is = *a > *b;
  *a = (eight)(((eight_int)*a & is) | ((eight_int)*b & ~is));
}

static inline void least(eight *a, const eight *b) {
  eight_int is = *a < *b;
  *a = (eight)(((eight_int)*a & is) | ((eight_int)*b & ~is));
}

/* Adds the areas right of line k and of each of eight others from `at` on. */
static inline void add_pairs(const cs_crowd_numbers *n, size_t k, size_t at, eight *sum) {
  eight x, slope, top, foot, weight, zero = {0};
  load(&x, n->x + at);
  load(&slope, n->slope + at);
  load(&top, n->top + at);
  load(&foot, n->foot + at);
  load(&weight, n->weight + at);
  eight from = zero + n->top[k], to = zero + n->foot[k];
  most(&from, &top);
  least(&to, &foot);
  eight height = to - from;
  most(&height, &zero);
  eight own_top = n->x[k] + n->slope[k] * (from - n->top[k]);
  eight own_foot = n->x[k] + n->slope[k] * (to - n->top[k]);
  eight above = x + slope * (from - top), below = x + slope * (to - top);
  eight over = own_top - above, under = own_foot - below, product = over * under;
  least(&product, &zero);
  most(&above, &own_top);
  most(&below, &own_foot);
  eight far = (eight)((eight_int)over & 0x7fffffff) + (eight)((eight_int)under & 0x7fffffff);
  *sum += weight * n->direction[k] * height *
          (2.0f * CS_CROWD_UNIT - above - below - product / (far + 1e-6f));
}

float CS_WIDE(cs_crowd_solver_joint)(const cs_crowd_numbers *n, size_t first, size_t end) {
  eight sum = {0};
  for (size_t k = first; k < end; k++)
    for (size_t at = 0; at < first; at += CS_CROWD_SUMS)
      add_pairs(n, k, at, &sum);
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}
