/* Which places of a row lie in one stretch of a gradient, and their shares of the way from one stop
 * to the next: for kernels (base/wide.h). */
#pragma once

#include "engine/compose/layer.h"

/* A paint in the form in which it is folded; lane 3 has no meaning. */
typedef struct cs_shade_lanes {
  cs_v4 s, t;
} cs_shade_lanes;

/* The colours of a gradient from one stop to the next, before the first or after the last. */
typedef struct cs_shade_stretch {
  double from, to;            /* [from, to) along the stops */
  double length;              /* 0: the paint is the same everywhere */
  cs_shade_lanes paint, step; /* at its beginning, and from there to its end */
} cs_shade_stretch;

enum { CS_SHADE_STRETCH_TOGETHER = 8 };

/* Whether all of the places lie in [from, to). */
static inline bool cs_shade_stretch_holds(const double *at, double from, double to) {
  int64_t outside = 0;
#pragma omp simd reduction(| : outside)
  for (int32_t i = 0; i < CS_SHADE_STRETCH_TOGETHER; i++)
    outside |= (at[i] >= from ? 0 : 1) | (at[i] < to ? 0 : 1);
  return outside == 0;
}

/* How many places lie in a stretch, from the first one on, which does. */
static inline int32_t cs_shade_stretch_extent(const cs_shade_stretch *part, const double *at,
                                              int32_t count) {
  int32_t k = 0;
  while (k + CS_SHADE_STRETCH_TOGETHER <= count &&
         cs_shade_stretch_holds(at + k, part->from, part->to))
    k += CS_SHADE_STRETCH_TOGETHER;
  k = k > 0 ? k : 1;
  while (k < count && at[k] >= part->from && at[k] < part->to)
    k++;
  return k;
}

/* The shares of the way from one stop to the next. */
static inline void cs_shade_stretch_shares(const cs_shade_stretch *part, const double *restrict at,
                                           int32_t count, float *restrict shares) {
  const double from = part->from, length = part->length;
  if (length == 0) {
    memset(shares, 0, (size_t)count * sizeof *shares);
    return;
  }
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    shares[k] = (float)((at[k] - from) / length);
}

/* Whether light and fade leave the paints of a layer as they are, to the bit. */
static inline bool cs_shade_is_bare(const cs_layer *layer) {
  return layer->fade == 1 && layer->front[0] == 1 && layer->front[1] == 1 && layer->front[2] == 1;
}
