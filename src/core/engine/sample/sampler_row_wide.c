/* The sampler's loops over the pixels of upright pictures. Everything that could depend on the
 * instructions is written out: no division where a product is meant, every sum in its order.
 */
#include "engine/sample/sampler_level.h"
#include "engine/sample/sampler_row.h"

#define SAME CS_SAMPLER_SAME

typedef float texel __attribute__((vector_size(16)));

void CS_WIDE(cs_sampler_mix_rows)(const float (*a)[4], const float (*b)[4], float share,
                                  int32_t count, float (*out)[4]) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++)
      out[i][c] = a[i][c] + share * (b[i][c] - a[i][c]);
}

void CS_WIDE(cs_sampler_add_row)(const float (*restrict texels)[4],
                                 const float (*restrict first)[4], float weight, int32_t count,
                                 float (*restrict sum)[4]) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++)
      sum[i][c] += weight * (texels[i][c] - first[i][c]);
}

void CS_WIDE(cs_sampler_end_sum)(const float (*restrict first)[4], float total, int32_t count,
                                 float (*restrict sum)[4]) {
  for (int32_t i = 0; i < count; i++)
    for (int c = 0; c < 4; c++)
      sum[i][c] = first[i][c] + sum[i][c] / total;
}

void CS_WIDE(cs_sampler_cut_row)(const cs_sampler_axis *axis, const double *u, int32_t count,
                                 cs_sampler_extent *restrict boxes) {
  const cs_sampler_axis a = *axis;
  for (int32_t i = 0; i < count; i++)
    boxes[i] = cs_sampler_cut(&a, u[i]);
}

void CS_WIDE(cs_sampler_place_row)(const cs_sampler *sampler, int32_t x0, int32_t count, double y,
                                   double *restrict u) {
  double step = sampler->m[0], start = sampler->m[1] * y + sampler->m[2];
  for (int32_t i = 0; i < count; i++)
    u[i] = step * ((double)(x0 + i) + 0.5) + start;
}

void CS_WIDE(cs_sampler_place_columns)(const cs_sampler *sampler, const int32_t *restrict columns,
                                       int32_t count, double y, double *restrict u) {
  double step = sampler->m[0], start = sampler->m[1] * y + sampler->m[2];
  for (int32_t i = 0; i < count; i++)
    u[i] = step * ((double)columns[i] + 0.5) + start;
}

void CS_WIDE(cs_sampler_clamp_row)(int32_t count, double *u) {
  for (int32_t i = 0; i < count; i++)
    u[i] = cs_sampler_bounded(u[i]);
}

void CS_WIDE(cs_sampler_floor_row)(const double *restrict u, int32_t count, int32_t *restrict at) {
  for (int32_t i = 0; i < count; i++) {
    double place = u[i] + SAME;
    int32_t whole = (int32_t)place;
    at[i] = whole - (place < whole);
  }
}

void CS_WIDE(cs_sampler_split_row)(const double *restrict u, int32_t count, int32_t *restrict at,
                                   float *restrict across) {
  for (int32_t i = 0; i < count; i++) {
    double place = u[i] - 0.5;
    int32_t left = (int32_t)(place + SAME);
    left -= place + SAME < left;
    double rest = place - left;
    at[i] = left;
    across[i] = rest < SAME ? 0.0f : (float)rest;
  }
}

void CS_WIDE(cs_sampler_mix_along)(const float (*restrict texels)[4], int32_t first,
                                   const int32_t *restrict at, const float *restrict across,
                                   int32_t count, float (*restrict rgba)[4]) {
  for (int32_t i = 0; i < count; i++) {
    texel left, right;
    memcpy(&left, texels[at[i] - first], sizeof left);
    memcpy(&right, texels[at[i] - first + 1], sizeof right);
    left += across[i] * (right - left);
    memcpy(rgba[i], &left, sizeof left);
  }
}
