/* The sampler's loops over the pixels of turned pictures. Everything that could depend on the
 * instructions is written out: no division where a product is meant, every sum in its order.
 */
#include "engine/sample/sampler_level.h"
#include "engine/sample/sampler_taps.h"

#define SAME CS_SAMPLER_SAME

typedef float pair __attribute__((vector_size(32))); /* two texels */
typedef float texel __attribute__((vector_size(16)));

/* ---------------------------------------------------------------- places */

void CS_WIDE(cs_sampler_map_affine)(const double m[9], int32_t x0, int32_t count, double y,
                                    cs_sampler_centres *restrict centres) {
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5], m0 = m[0], m3 = m[3];
  for (int32_t i = 0; i < count; i++) {
    double x = (double)(x0 + i) + 0.5;
    centres->u[i] = m0 * x + row_u;
    centres->v[i] = m3 * x + row_v;
    centres->near[i] = 1;
  }
}

void CS_WIDE(cs_sampler_map_perspective)(const double m[9], int32_t x0, int32_t count, double y,
                                         cs_sampler_centres *restrict centres) {
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5], row_w = m[7] * y + m[8];
  double m0 = m[0], m3 = m[3], m6 = m[6];
  for (int32_t i = 0; i < count; i++) {
    double x = (double)(x0 + i) + 0.5, w = m6 * x + row_w;
    double near = 1 / w, u = (m0 * x + row_u) * near, v = (m3 * x + row_v) * near;
    bool is_before = (w > 0) & (fabs(u) < 1e15) & (fabs(v) < 1e15);
    centres->u[i] = is_before ? u : 0;
    centres->v[i] = is_before ? v : 0;
    centres->near[i] = is_before ? near : 0;
  }
}

void CS_WIDE(cs_sampler_mark_visible)(const cs_sampler *sampler, int32_t count,
                                      cs_sampler_centres *restrict centres) {
  double last = 0, right = 0, bottom = 0;
  if (sampler->wrap == CELSPAN_WRAP_CLEAR) {
    last = -SAME;
    right = sampler->width - SAME;
    bottom = sampler->height - SAME;
  } else {
    last = -INFINITY;
    right = bottom = INFINITY;
  }
  for (int32_t i = 0; i < count; i++) {
    double u = centres->u[i], v = centres->v[i];
    centres->visible[i] =
        -(int32_t)((u >= last) & (u < right) & (v >= last) & (v < bottom) & (centres->near[i] > 0));
  }
}

/* ---------------------------------------------------------------- taps */

void CS_WIDE(cs_sampler_plan_taps)(const cs_sampler *sampler, int32_t count,
                                   const cs_sampler_centres *restrict centres,
                                   int32_t *restrict plans) {
  const double *m = sampler->m;
  double m0 = m[0], m1 = m[1], m3 = m[3], m4 = m[4], m6 = m[6], m7 = m[7];
  int32_t top = sampler->level_count - 1;
  for (int32_t i = 0; i < count; i++) {
    double u = centres->u[i], v = centres->v[i], near = centres->near[i];
    double ux = (m0 - u * m6) * near, vx = (m3 - v * m6) * near;
    double uy = (m1 - u * m7) * near, vy = (m4 - v * m7) * near;
    double right = ux * ux + vx * vx, below = uy * uy + vy * vy;
    double shorter = right < below ? right : below, longer = right < below ? below : right;
    int32_t level = cs_sampler_halvings(shorter, 2 * CS_SAMPLER_TAP_TEXELS);
    int32_t needed = cs_sampler_halvings(longer, CS_SAMPLER_MOST_TAPS);
    level = level > needed ? level : needed;
    level = level < top ? level : top;
    double side = (double)((int64_t)1 << level);
    bool fits = (fabs(ux) + fabs(uy) <= 1 + SAME) & (fabs(vx) + fabs(vy) <= 1 + SAME);
    int32_t columns = fits ? 1 : cs_sampler_tap_count(right, side),
            rows = fits ? 1 : cs_sampler_tap_count(below, side);
    plans[i] = level << 16 | columns << 8 | rows;
  }
}

void CS_WIDE(cs_sampler_move)(const cs_sampler *sampler, cs_sampler_tap tap, int32_t from,
                              int32_t count, const cs_sampler_centres *restrict centres,
                              double *restrict out_u, double *restrict out_v) {
  const double *m = sampler->m;
  double limit = sampler->wrap == CELSPAN_WRAP_REPEAT ? INFINITY : 1e9;
  double across = tap.x * m[0] + tap.y * m[1], down = tap.x * m[3] + tap.y * m[4];
  double bend = tap.x * m[6] + tap.y * m[7];
  for (int32_t i = 0; i < count; i++) {
    double u = centres->u[from + i], v = centres->v[from + i], near = centres->near[from + i];
    u += (across - u * bend) * near;
    v += (down - v * bend) * near;
    u = u > -limit ? u : -limit;
    v = v > -limit ? v : -limit;
    out_u[i] = u < limit ? u : limit;
    out_v[i] = v < limit ? v : limit;
  }
}

void CS_WIDE(cs_sampler_find_quads)(const cs_sampler *sampler, int level, int32_t count,
                                    const double *restrict u, const double *restrict v,
                                    cs_sampler_quads *restrict quads) {
  double scale = 1.0 / (double)((int64_t)1 << level);
  int32_t right = cs_mip_levels_size(sampler->width, level) - 1;
  int32_t bottom = cs_mip_levels_size(sampler->height, level) - 1;
  const int32_t last = CS_PICTURE_BLOCK - 1;
  for (int32_t i = 0; i < count; i++) {
    double a = u[i] * scale - 0.5, b = v[i] * scale - 0.5;
    int32_t x = (int32_t)(a + SAME), y = (int32_t)(b + SAME);
    x -= a + SAME < x;
    y -= b + SAME < y;
    double across = a - x, down = b - y;
    quads->across[i] = across < SAME ? 0.0f : (float)across;
    quads->down[i] = down < SAME ? 0.0f : (float)down;
    quads->x[i] = x;
    quads->y[i] = y;
    bool is_whole = (x >= 0) & (y >= 0) & (x < right) & (y < bottom) & ((x & last) != last) &
                    ((y & last) != last);
    quads->key[i] = is_whole ? (y / CS_PICTURE_BLOCK) << 15 | x / CS_PICTURE_BLOCK : -1;
    quads->offset[i] = (y & last) * CS_PICTURE_BLOCK + (x & last);
  }
}

void CS_WIDE(cs_sampler_place_taps)(const cs_sampler *sampler, int32_t x0, int32_t count, double y,
                                    double *restrict u, double *restrict v) {
  const double *m = sampler->m;
  double row_u = m[1] * y + m[2], row_v = m[4] * y + m[5], m0 = m[0], m3 = m[3];
  for (int32_t i = 0; i < count; i++) {
    double x = (double)(x0 + i) + 0.5;
    u[i] = cs_sampler_bounded(m0 * x + row_u);
    v[i] = cs_sampler_bounded(m3 * x + row_v);
  }
}

void CS_WIDE(cs_sampler_mix_quads)(const float *restrict block, const cs_sampler_quads *quads,
                                   int32_t from, int32_t count, ptrdiff_t ahead,
                                   float (*restrict rgba)[4]) {
  for (int32_t i = from; i < from + count; i++) {
    const float *at = block + 4 * (size_t)quads->offset[i];
    __builtin_prefetch((const char *)at + ahead);
    pair above, below;
    memcpy(&above, at, sizeof above);
    memcpy(&below, at + 4 * CS_PICTURE_BLOCK, sizeof below);
    pair column = above + quads->down[i] * (below - above);
    texel left = __builtin_shufflevector(column, column, 0, 1, 2, 3);
    texel right = __builtin_shufflevector(column, column, 4, 5, 6, 7);
    texel mixed = left + quads->across[i] * (right - left);
    memcpy(rgba[i - from], &mixed, sizeof mixed);
  }
}

void CS_WIDE(cs_sampler_clear_invisible)(const int32_t *restrict visible, int32_t count,
                                         float (*restrict rgba)[4]) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++)
      rgba[i][c] = visible[i] ? rgba[i][c] : 0;
}
