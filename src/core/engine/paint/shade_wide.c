/* Plain loops that the compiler turns into vector code: see shade.h. */
#include "engine/paint/shade.h"

#include "engine/compose/over.h"
#include "engine/paint/over_wide.h"
#include "engine/paint/shade_stretch.h"

/* is_radial: a constant of each caller. */
static inline void find_places(const cs_shade *restrict shade, const double *restrict x,
                               int32_t count, double y, double *restrict at, bool is_radial) {
  const cs_shade_row row = cs_shade_row_of(shade, y);
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    at[k] = cs_shade_row_at(&row, x[k], is_radial, true);
}

void CS_WIDE(cs_shade_places)(const cs_shade *shade, const double *x, int32_t count, double y,
                              double *at) {
  if (!shade->is_affine || shade->texture->kind == CS_TEXTURE_CONIC)
    for (int32_t k = 0; k < count; k++)
      at[k] = cs_shade_at(shade, x[k], y);
  else if (shade->texture->kind == CS_TEXTURE_RADIAL)
    find_places(shade, x, count, y, at, true);
  else
    find_places(shade, x, count, y, at, false);
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

int32_t CS_WIDE(cs_shade_blend)(const cs_shade_stretch *part, const double *at, int32_t count,
                                float (*s)[4], float (*t)[4]) {
  float shares[CS_SHADE_PLACES + CS_WIDE_LANES]; /* whole registers are read */
  count = cs_shade_stretch_extent(part, at, count);
  cs_shade_stretch_shares(part, at, count, shares);
  fill(part->paint.s, part->step.s, shares, count, s);
  if (t)
    fill(part->paint.t, part->step.t, shares, count, t);
  return count;
}

/* ---------------------------------------------------------------- as a layer */

/* Pixels that are added, and how. is_lit, a constant of each caller: light and fade change paints;
 * is_first, too: nothing has been added before. */
typedef struct added {
  const cs_shade_stretch *part;
  const cs_layer *layer;
  const float *shares;
  int32_t count;
} added;

static inline void add_wide(const added *a, bool is_lit, bool is_first, float (*e)[4],
                            float (*t)[4]) {
  const cs_shade_stretch *part = a->part;
  const cs_wide s0 = cs_over_wide_all((const float *)&part->paint.s),
                t0 = cs_over_wide_all((const float *)&part->paint.t),
                s1 = cs_over_wide_all((const float *)&part->step.s),
                t1 = cs_over_wide_all((const float *)&part->step.t),
                light = cs_over_wide_all((const float *)&a->layer->front);
  const float fade = a->layer->fade;
  for (int32_t k = 0; k + CS_OVER_WIDE_PIXELS <= a->count; k += CS_OVER_WIDE_PIXELS) {
    const cs_wide share = spread(a->shares + k);
    const cs_wide ps = s0 + share * s1, pt = t0 + share * t1;
    const cs_wide through = is_first ? cs_wide_all(1) : cs_wide_load(t[k]);
    const cs_wide gathered = is_first ? cs_wide_all(0) : cs_wide_load(e[k]);
    cs_wide_store(e[k], gathered + through * (is_lit ? light * (fade * ps) : ps));
    cs_wide_store(t[k], through * (is_lit ? (1 - fade) + fade * pt : pt));
  }
}

/* The pixels after the last whole register. */
static inline void add_last(const added *a, bool is_first, float (*e)[4], float (*t)[4]) {
  const cs_shade_stretch *part = a->part;
  for (int32_t k = a->count / CS_OVER_WIDE_PIXELS * CS_OVER_WIDE_PIXELS; k < a->count; k++) {
    cs_over_pair front = cs_over_pair_clear;
    if (!is_first)
      front = (cs_over_pair){cs_v4_load(e[k]), cs_v4_load(t[k])};
    front = cs_over_pair_over(front, cs_over_lit(a->layer->front, a->layer->fade,
                                                 part->paint.s + a->shares[k] * part->step.s,
                                                 part->paint.t + a->shares[k] * part->step.t));
    cs_v4_store(e[k], front.e);
    cs_v4_store(t[k], front.t);
  }
}

int32_t CS_WIDE(cs_shade_add)(const cs_shade_stretch *part, const cs_layer *layer, const double *at,
                              int32_t count, bool is_first, float (*e)[4], float (*t)[4]) {
  float shares[CS_SHADE_PLACES + CS_WIDE_LANES]; /* whole registers are read */
  const bool is_lit = !cs_shade_is_bare(layer);
  const added a = {part, layer, shares, cs_shade_stretch_extent(part, at, count)};
  cs_shade_stretch_shares(part, at, a.count, shares);
  if (is_first)
    add_wide(&a, true, true, e, t);
  else if (is_lit)
    add_wide(&a, true, false, e, t);
  else
    add_wide(&a, false, false, e, t);
  add_last(&a, is_first, e, t);
  return a.count;
}
