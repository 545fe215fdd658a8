#include "engine/sample/sampler_pixel.h"

#include <math.h>

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

cs_sampler_axis cs_sampler_axis_of(const cs_sampler *sampler, double width, int32_t size) {
  bool repeats = sampler->wrap == CELSPAN_WRAP_REPEAT;
  double side = (double)((int64_t)1 << sampler->level);
  return (cs_sampler_axis){.width = width,
                           .least = repeats ? -INFINITY : 0,
                           .most = repeats ? INFINITY : size,
                           .side = side,
                           .inverse = 1 / side};
}

static void sample_box(const cs_sampling *run, const cs_sampler_axis *wide,
                       const cs_sampler_axis *high, double u, double v, float rgba[4]) {
  const cs_sampler *s = run->sampler;
  const cs_sampler_extent across = cs_sampler_cut(wide, u), down = cs_sampler_cut(high, v);
  cs_v4 first = {0}, sum = {0};
  float total = 0;
  for (int32_t j = 0; j < down.count; j++)
    for (int32_t i = 0; i < across.count; i++) {
      float weight = cs_sampler_weight(wide, &across, i) * cs_sampler_weight(high, &down, j);
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
  const cs_sampler_axis wide = cs_sampler_axis_of(s, s->wide, s->width);
  const cs_sampler_axis high = cs_sampler_axis_of(s, s->high, s->height);
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
      sample_box(run, &wide, &high, u, v, rgba[i]);
  }
}
