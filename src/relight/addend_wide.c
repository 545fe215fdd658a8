/* Sums over columns. Each number is computed by itself, so it does not depend on the instructions. */
#include "relight/addend.h"

void CS_WIDE(cs_addend_plane)(float *restrict out, const float *restrict in, float weight,
                              int32_t count) {
  for (int32_t i = 0; i < count; i++)
    out[i] += weight * in[i];
}

void CS_WIDE(cs_addend_constant)(float *out, float value, int32_t count) {
  for (int32_t i = 0; i < count; i++)
    out[i] += value;
}

void CS_WIDE(cs_addend_line)(float *out, float weight, float colour, float slope, int32_t first,
                             int32_t count) {
  for (int32_t i = 0; i < count; i++)
    out[i] += weight * (colour + slope * (float)(first + i));
}

void CS_WIDE(cs_addend_pixels)(const float *restrict planes, const float *restrict through,
                               float keep, int32_t count, float *restrict rgba) {
  const float *red = planes, *green = planes + count, *blue = planes + 2 * (size_t)count;
  for (int32_t i = 0; i < count; i++) {
    rgba[4 * i] = red[i];
    rgba[4 * i + 1] = green[i];
    rgba[4 * i + 2] = blue[i];
    rgba[4 * i + 3] = 1 - keep * through[i];
  }
}
