/* Places on a picture and the texels there.
 *
 *     u:   0        1        2        3 ...      texel i covers [i, i + 1), its centre is i + 1/2
 *          |   o    |   o    |   o    |
 *              |--*-----|
 *              a place between two centres is a texel and the share of its right neighbour, here .3
 *
 * Invariant: all sums over texels are made of differences to one of them, so a constant picture
 * keeps its value to the bit.
 */
#pragma once

#include <math.h>

#include "base/number.h"
#include "base/vector.h"
#include "engine/sample/placement.h"
#include "engine/sample/samples.h"
#include "engine/span/run.h"
#include "model/pictures/mip_levels.h"

/* Places closer than this share of a texel count as one: matrices carry errors of rounding, and
 * pictures have up to 2^20 pixels on a side. */
#define CS_SAMPLER_SAME 1e-6

typedef struct cs_sampling {
  const cs_sampler *sampler;
  cs_block_cache *blocks;
} cs_sampling;

/* floor, for places that fit into the result, without a call. */
static inline int32_t cs_sampler_floor(double x) {
  int32_t whole = (int32_t)x;
  return whole - (x < whole);
}

static inline int32_t cs_sampler_wrap(int32_t i, int32_t size, celspan_wrap mode) {
  if (i >= 0 && i < size)
    return i;
  if (mode != CELSPAN_WRAP_REPEAT)
    return i < 0 ? 0 : size - 1;
  int32_t rest = i % size;
  return rest < 0 ? rest + size : rest;
}

/* For kernels: a coordinate that fits an int32_t; NaN becomes the least. */
static inline double cs_sampler_bounded(double u) {
  u = u > -1e9 ? u : -1e9;
  return u < 1e9 ? u : 1e9;
}

/* A repeated picture is sampled near its own origin, so far tiles cost no precision. Afterwards a
 * coordinate fits an int32_t. */
static inline double cs_sampler_reduce(double u, int32_t size, celspan_wrap mode) {
  if (u >= 0 && u < size)
    return u;
  return mode == CELSPAN_WRAP_REPEAT ? u - floor(u / size) * size : cs_number_clamp(u, -1e9, 1e9);
}

/* Whether a centre leaves its pixel clear, along one axis. */
static inline bool cs_sampler_is_outside(double u, int32_t size, celspan_wrap mode) {
  return mode == CELSPAN_WRAP_CLEAR && !(u >= -CS_SAMPLER_SAME && u < size - CS_SAMPLER_SAME);
}

/* The texel left of or at u - 1/2 and the share of its right neighbour. */
static inline int32_t cs_sampler_split(double u, float *share) {
  int32_t left = cs_sampler_floor(u - 0.5 + CS_SAMPLER_SAME);
  double rest = u - 0.5 - left;
  *share = rest < CS_SAMPLER_SAME ? 0.0f : (float)rest;
  return left;
}

/* A wrapped texel. */
static inline const float *cs_sampling_texel(const cs_sampling *run, int level, int32_t x,
                                             int32_t y) {
  const cs_sampler *s = run->sampler;
  return cs_block_cache_at(run->blocks, &s->source, level,
                           cs_sampler_wrap(x, cs_mip_levels_size(s->width, level), s->wrap),
                           cs_sampler_wrap(y, cs_mip_levels_size(s->height, level), s->wrap));
}

/* Where a row stays a row: the centre of a column, and the height. */
static inline double cs_sampler_row_u(const cs_sampler *s, int32_t column, double y) {
  return s->m[0] * ((double)column + 0.5) + (s->m[1] * y + s->m[2]);
}

static inline double cs_sampler_row_v(const cs_sampler *s, double y) {
  return s->m[4] * y + s->m[5];
}
