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

/* One axis of a box at a level: texels and how many pixels of each it covers. */
typedef struct cs_sampler_extent {
  int32_t first, count;
  float weights[2 * CS_SAMPLER_MOST_BOX + 4];
} cs_sampler_extent;

void cs_sampler_cut_extent(const cs_sampler *sampler, double centre, double width, int32_t size,
                           cs_sampler_extent *out);
