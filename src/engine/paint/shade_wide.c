/* Plain loops that the compiler turns into vector code: see shade.h. */
#include "engine/paint/shade.h"

#include "engine/compose/over.h"
#include "engine/paint/over_wide.h"

/* is_radial, is_affine: constants of each caller. */
static inline void find_places(const cs_shade *restrict shade, const double *restrict x,
                               int32_t count, double y, double *restrict at, bool is_radial,
                               bool is_affine) {
  const cs_shade own = *shade; /* the compiler sees that nothing changes it */
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    at[k] = cs_shade_at_known(&own, x[k], y, is_radial, is_affine);
}

void CS_WIDE(cs_shade_places)(const cs_shade *shade, const double *x, int32_t count, double y,
                              double *at) {
  bool is_radial = shade->texture->kind == CS_TEXTURE_RADIAL;
  if (!shade->is_affine || shade->texture->kind == CS_TEXTURE_CONIC)
    for (int32_t k = 0; k < count; k++)
      at[k] = cs_shade_at(shade, x[k], y);
  else if (is_radial)
    find_places(shade, x, count, y, at, true, true);
  else
    find_places(shade, x, count, y, at, false, true);
}

enum { TOGETHER = 8 };

/* Whether all of TOGETHER places lie in [from, to). */
static inline bool are_inside(const double *at, double from, double to) {
  int64_t outside = 0;
#pragma omp simd reduction(| : outside)
  for (int32_t i = 0; i < TOGETHER; i++)
    outside |= (at[i] >= from ? 0 : 1) | (at[i] < to ? 0 : 1);
  return outside == 0;
}

/* How many places lie in a stretch, from the first one on, which does. */
static inline int32_t find_extent(const cs_shade_stretch *part, const double *at, int32_t count) {
  int32_t k = 0;
  while (k + TOGETHER <= count && are_inside(at + k, part->from, part->to))
    k += TOGETHER;
  k = k > 0 ? k : 1;
  while (k < count && at[k] >= part->from && at[k] < part->to)
    k++;
  return k;
}

/* The shares of the way from one stop to the next. */
static inline void find_shares(const cs_shade_stretch *part, const double *restrict at,
                               int32_t count, float *restrict shares) {
  const double from = part->from, length = part->length;
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    shares[k] = (float)((at[k] - from) / length);
}

/* The first shares of a register, each in all lanes of its pixel. */
static inline cs_wide spread(const float *shares) {
  cs_wide v = cs_wide_load(shares);
#if CS_WIDE_LANES == 16
  return __builtin_shufflevector(v, v, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
#elif CS_WIDE_LANES == 8
  return __builtin_shufflevector(v, v, 0, 0, 0, 0, 1, 1, 1, 1);
#else
  return CS_WIDE_SPREAD(v, 0);
#endif
}

static inline void fill(cs_v4 paint, cs_v4 step, const float *shares, int32_t count,
                        float (*out)[4]) {
  const cs_wide base = cs_over_wide_all((const float *)&paint);
  const cs_wide slope = cs_over_wide_all((const float *)&step);
  int32_t k = 0;
  for (; k + CS_OVER_WIDE_PIXELS <= count; k += CS_OVER_WIDE_PIXELS)
    cs_wide_store(out[k], base + spread(shares + k) * slope);
  for (; k < count; k++)
    cs_v4_store(out[k], paint + shares[k] * step);
}

/* Finds the shares of the places in a stretch, and returns how many there are. */
static inline int32_t begin_stretch(const cs_shade_stretch *part, const double *at, int32_t count,
                                    float *shares) {
  count = find_extent(part, at, count);
  if (part->length != 0)
    find_shares(part, at, count, shares);
  else
    memset(shares, 0, (size_t)count * sizeof *shares);
  return count;
}

int32_t CS_WIDE(cs_shade_blend)(const cs_shade_stretch *part, const double *at, int32_t count,
                                float (*s)[4], float (*t)[4]) {
  float shares[CS_SHADE_PLACES + CS_WIDE_LANES]; /* whole registers are read */
  count = begin_stretch(part, at, count, shares);
  fill(part->paint.s, part->step.s, shares, count, s);
  fill(part->paint.t, part->step.t, shares, count, t);
  return count;
}

/* ---------------------------------------------------------------- as a layer */

/* The paint at a share of the way, lit and faded as cs_over_lit does it. is_lit, a constant of each
 * caller: neither changes it otherwise. */
static inline void add_pixels(const cs_shade_stretch *part, const cs_layer *layer,
                              const float *shares, int32_t count, float (*e)[4], float (*t)[4],
                              bool is_lit) {
  const cs_wide s0 = cs_over_wide_all((const float *)&part->paint.s),
                t0 = cs_over_wide_all((const float *)&part->paint.t),
                s1 = cs_over_wide_all((const float *)&part->step.s),
                t1 = cs_over_wide_all((const float *)&part->step.t),
                light = cs_over_wide_all((const float *)&layer->front);
  const float fade = layer->fade;
  int32_t k = 0;
  for (; k + CS_OVER_WIDE_PIXELS <= count; k += CS_OVER_WIDE_PIXELS) {
    const cs_wide share = spread(shares + k), through = cs_wide_load(t[k]);
    const cs_wide ps = s0 + share * s1, pt = t0 + share * t1;
    cs_wide_store(e[k], cs_wide_load(e[k]) + through * (is_lit ? light * (fade * ps) : ps));
    cs_wide_store(t[k], through * (is_lit ? (1 - fade) + fade * pt : pt));
  }
  for (; k < count; k++) {
    const cs_over_pair lit =
        cs_over_lit(layer->front, fade, part->paint.s + shares[k] * part->step.s,
                    part->paint.t + shares[k] * part->step.t);
    const cs_v4 through = cs_v4_load(t[k]);
    cs_v4_store(e[k], cs_v4_load(e[k]) + through * lit.e);
    cs_v4_store(t[k], through * lit.t);
  }
}

/* Whether light and fade leave paints as they are, to the bit. */
static inline bool is_bare(const cs_layer *layer) {
  return layer->fade == 1 && layer->front[0] == 1 && layer->front[1] == 1 && layer->front[2] == 1;
}

int32_t CS_WIDE(cs_shade_add)(const cs_shade_stretch *part, const cs_layer *layer, const double *at,
                              int32_t count, float (*e)[4], float (*t)[4]) {
  float shares[CS_SHADE_PLACES + CS_WIDE_LANES]; /* whole registers are read */
  count = begin_stretch(part, at, count, shares);
  if (is_bare(layer))
    add_pixels(part, layer, shares, count, e, t, false);
  else
    add_pixels(part, layer, shares, count, e, t, true);
  return count;
}
