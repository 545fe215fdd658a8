/* The stretches of a gradient from one stop to the next; which places of a row lie in one, and
 * their shares of the way from its beginning to its end: for kernels (base/wide.h). */
#pragma once

#include <assert.h>
#include <math.h>
#include <stddef.h>

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

/* ---------------------------------------------------------------- the stretch of a place */

/* Three floats, of four that are there; lane 3 is 0. */
static inline cs_v4 cs_shade_stretch_three(const float *channels) {
  cs_v4 out = cs_v4_load(channels);
  out[3] = 0;
  return out;
}

static_assert(offsetof(cs_paint, t) == 3 * sizeof(float), "what follows s is t");
static_assert(offsetof(cs_paint, beta) == 6 * sizeof(float), "what follows t is beta");

static inline cs_shade_lanes cs_shade_stretch_lanes(const cs_paint *paint) {
  const float *channels = (const float *)paint;
  return (cs_shade_lanes){cs_shade_stretch_three(channels), cs_shade_stretch_three(channels + 3)};
}

/* The first stop behind a place, or their number. */
static inline size_t cs_shade_stretch_stop_after(const celspan_texture *texture, double at) {
  const cs_stop *stops = texture->variation->stops;
  size_t count = texture->variation->stop_count, next = 0;
  while (next < count && stops[next].at <= at)
    next++;
  return next;
}

/* Behind the horizon, where the place is not a number, the stretch is clear and holds no place. */
static inline cs_shade_stretch cs_shade_stretch_at(const celspan_texture *texture, double at) {
  const cs_stop *stops = texture->variation->stops;
  size_t count = texture->variation->stop_count, next = cs_shade_stretch_stop_after(texture, at);
  const cs_paint clear = CS_PAINT_CLEAR;
  if (at != at)
    return (cs_shade_stretch){.from = INFINITY, .paint = cs_shade_stretch_lanes(&clear)};
  cs_shade_stretch out = {-INFINITY,
                          INFINITY,
                          0,
                          cs_shade_stretch_lanes(&stops[next == 0 ? 0 : next - 1].paint),
                          {{0}, {0}}};
  if (next > 0)
    out.from = stops[next - 1].at;
  if (next < count)
    out.to = stops[next].at;
  if (next > 0 && next < count) {
    cs_shade_lanes end = cs_shade_stretch_lanes(&stops[next].paint);
    out.length = out.to - out.from;
    out.step = (cs_shade_lanes){end.s - out.paint.s, end.t - out.paint.t};
  }
  return out;
}

/* ---------------------------------------------------------------- the places in a stretch */

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
