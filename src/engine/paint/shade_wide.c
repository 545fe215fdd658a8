/* Plain loops that the compiler turns into vector code: see shade.h. */
#include "engine/paint/shade.h"

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

void CS_WIDE(cs_shade_shares)(const double *restrict at, int32_t count, double from, double length,
                              float *restrict shares) {
#pragma omp simd
  for (int32_t k = 0; k < count; k++)
    shares[k] = (float)((at[k] - from) / length);
}

int32_t CS_WIDE(cs_shade_extent)(const double *at, int32_t count, double from, double to) {
  enum { TOGETHER = 8 };
  int32_t k = 0, inside = TOGETHER;
  for (; k + TOGETHER <= count && inside == TOGETHER; k += TOGETHER) {
    inside = 0;
#pragma omp simd reduction(+ : inside)
    for (int32_t i = 0; i < TOGETHER; i++)
      inside += (at[k + i] >= from) & (at[k + i] < to);
  }
  k -= inside == TOGETHER ? 0 : TOGETHER;
  while (k < count && at[k] >= from && at[k] < to)
    k++;
  return k;
}
