#include "engine/sample/sampler_pixel.h"

/* Catmull-Rom weights: interpolating, so that scale 1 gives the texels back. */
static void cubic_weights(float t, float weights[4]) {
  float t2 = t * t, t3 = t2 * t;
  weights[0] = 0.5f * (2 * t2 - t3 - t);
  weights[1] = 0.5f * (3 * t3 - 5 * t2 + 2);
  weights[2] = 0.5f * (4 * t2 - 3 * t3 + t);
  weights[3] = 0.5f * (t3 - t2);
}

/* Clamped to the range of the texels under the kernel, so that its negative lobes add neither light
 * nor dark of their own. */
void cs_sampler_bicubic(const cs_sampling *run, double u, double v, float rgba[4]) {
  float across, down, wx[4], wy[4];
  int32_t x = cs_sampler_split(u, &across), y = cs_sampler_split(v, &down);
  cubic_weights(across, wx);
  cubic_weights(down, wy);
  cs_v4 first = {0}, sum = {0}, low = {0}, high = {0};
  for (int i = 0; i < 16; i++) {
    cs_v4 texel = cs_v4_load(cs_sampling_texel(run, 0, x - 1 + i % 4, y - 1 + i / 4));
    if (i == 0)
      first = low = high = texel;
    sum += wx[i % 4] * wy[i / 4] * (texel - first);
    low = cs_v4_min(low, texel);
    high = cs_v4_max(high, texel);
  }
  cs_v4_store(rgba, cs_v4_min(cs_v4_max(sum + first, low), high));
}

/* ---------------------------------------------------------------- the box */

void cs_sampler_cut_extent(const cs_sampler *sampler, double centre, double width, int32_t size,
                           cs_sampler_extent *out) {
  double low = centre - 0.5 * width, high = low + width;
  double side = (double)((int64_t)1 << sampler->level);
  if (sampler->wrap != CELSPAN_WRAP_REPEAT) { /* a box far larger than the picture is the picture */
    low = cs_number_clamp(low, 0, size);
    high = cs_number_clamp(high, 0, size);
  }
  /* Within SAME of a texel's edge the neighbour is not touched. */
  int32_t first = cs_sampler_floor((low + CS_SAMPLER_SAME) / side);
  int32_t last = -cs_sampler_floor((CS_SAMPLER_SAME - high) / side);
  out->first = first;
  out->count = last > first ? last - first : 1;
  for (int32_t i = 0; i < out->count; i++) {
    double left = i ? (first + i) * side : low;
    double right = i + 1 < out->count ? (first + i + 1) * side : high;
    out->weights[i] = right > left ? (float)(right - left) : 1.0f;
  }
}

static void sample_box(const cs_sampling *run, double u, double v, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  cs_sampler_extent across, down;
  cs_sampler_cut_extent(s, u, s->wide, s->width, &across);
  cs_sampler_cut_extent(s, v, s->high, s->height, &down);
  cs_v4 first = {0}, sum = {0};
  float total = 0;
  for (int32_t j = 0; j < down.count; j++)
    for (int32_t i = 0; i < across.count; i++) {
      float weight = across.weights[i] * down.weights[j];
      cs_v4 texel = cs_v4_load(cs_sampling_texel(run, s->level, across.first + i, down.first + j));
      if (i == 0 && j == 0)
        first = texel;
      sum += weight * (texel - first);
      total += weight;
    }
  cs_v4_store(rgba, first + sum / total);
}

void cs_sampler_pixel_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]) {
  const cs_sampler *s = run->sampler;
  const double *m = s->m;
  double row_u = m[1] * pixels.y + m[2], row_v = m[4] * pixels.y + m[5];
  for (int32_t i = 0; i < pixels.x1 - pixels.x0; i++) {
    double x = (double)(pixels.x0 + i) + 0.5, u = m[0] * x + row_u, v = m[3] * x + row_v;
    if (cs_sampler_is_outside(u, s->width, s->wrap) ||
        cs_sampler_is_outside(v, s->height, s->wrap)) {
      memset(rgba[i], 0, sizeof *rgba);
      continue;
    }
    u = cs_sampler_reduce(u, s->width, s->wrap);
    v = cs_sampler_reduce(v, s->height, s->wrap);
    if (s->kernel == CS_SAMPLER_BICUBIC)
      cs_sampler_bicubic(run, u, v, rgba[i]);
    else
      sample_box(run, u, v, rgba[i]);
  }
}
