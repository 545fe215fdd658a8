/* Samples that are made one by one: bicubic, and means over boxes where rows become columns.
 *
 *     one axis of a box         low               high
 *                                |                 |
 *                       |-----|--===|=====|=====|===--|-----|      texels; = is covered
 *     texels                   first               last
 *     weights                   .6     1     1    .6               how much of each is covered
 */
#pragma once

#include "engine/sample/sampler_level.h"

void cs_sampler_pixel_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]);
/* One bicubic sample, at a place brought into the picture by cs_sampler_reduce. */
void cs_sampler_bicubic(const cs_sampling *run, double u, double v, float rgba[4]);

/* The values that all boxes of a picture share along an axis, in its pixels. */
typedef struct cs_sampler_axis {
  double width;         /* the width of a box */
  double least, most;   /* the edges of the picture, unless it repeats */
  double side, inverse; /* a texel's side on the level: a power of two, so both are exact */
} cs_sampler_axis;

cs_sampler_axis cs_sampler_axis_of(const cs_sampler *sampler, double width, int32_t size);

/* One axis of a box: texels, and how much of the first and of the last one is covered; all others
 * are covered wholly. */
typedef struct cs_sampler_extent {
  int32_t first, count;
  float head, tail; /* in pixels; of one texel both are the same */
} cs_sampler_extent;

static inline cs_sampler_extent cs_sampler_cut(const cs_sampler_axis *axis, double centre) {
  double low = centre - 0.5 * axis->width, high = low + axis->width;
  /* A box far larger than the picture is the picture. */
  low = cs_number_clamp(low, axis->least, axis->most);
  high = cs_number_clamp(high, axis->least, axis->most);
  /* Within SAME of a texel's edge the neighbour is not touched. */
  int32_t first = cs_sampler_floor((low + CS_SAMPLER_SAME) * axis->inverse);
  int32_t last = -1 - cs_sampler_floor((CS_SAMPLER_SAME - high) * axis->inverse);
  last = last > first ? last : first;
  double end = last > first ? (first + 1) * axis->side : high;
  double begin = last > first ? last * axis->side : low;
  return (cs_sampler_extent){first, last - first + 1, end > low ? (float)(end - low) : 1.0f,
                             high > begin ? (float)(high - begin) : 1.0f};
}

/* The weight of texel i of an extent. */
static inline float cs_sampler_weight(const cs_sampler_axis *axis, const cs_sampler_extent *extent,
                                      int32_t i) {
  return i == 0 ? extent->head : i + 1 == extent->count ? extent->tail : (float)axis->side;
}
