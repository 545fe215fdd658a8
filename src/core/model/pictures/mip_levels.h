/* Pictures as light: coded pixels are decoded, and mip levels computed, each from the one below it.
 *
 *   level 0     |  0  |  1  |  2  |  3  |  4  |     5 pixels
 *   level 1     |     0     |     1     |  2  |     the last texel has one pixel, not two
 *   level 2     |           0           |  1  |
 *   level 3     |              0              |     the mean of all, weighted by pixels
 *
 * Level k has ceil(size / 2^k) texels a side. Texel i is the mean, in linear light and
 * premultiplied, of the picture's pixels [i 2^k, (i + 1) 2^k) that exist.
 *
 * INVARIANT: a texel is a function of the four below it alone, so its bits do not depend on the
 * order or the sizes in which a level was computed.
 */
#pragma once

#include "model/pictures/module.h"

/* Texels along an axis of `size` pixels at `level`. */
static inline int32_t cs_mip_levels_size(int32_t size, int level) {
  return (int32_t)(((int64_t)size + ((int64_t)1 << level) - 1) >> level);
}

/* The number of levels, from level 0 to the level of a single texel. */
int cs_mip_levels_count(int32_t width, int32_t height);

/* A level of a picture of width x height pixels. */
typedef struct cs_mip_level {
  int32_t width, height;
  int level;
} cs_mip_level;

/* Texels [x, x + count) of two rows of a level: of row y, and of row y + 1 or NULL when there is
 * none. x and y are even. */
typedef struct cs_mip_rows {
  int32_t x, y, count;
  const float *upper, *lower;
} cs_mip_rows;

/* The row of the next level. out: (count + 1) / 2 texels; may be rows->upper. */
void cs_mip_levels_mean(const cs_mip_level *from, const cs_mip_rows *rows, float *out);

typedef struct cs_mip_levels_decoder {
  celspan_transfer transfer;
  cs_picture_alpha alpha;
  bool is_linear;     /* pixels are linear light already */
  bool has_matrix;    /* the light of the pixels has other primaries: */
  double matrix[9];   /* the matrix to celspan's, in rows */
  const float *table; /* linear light by code, NULL for floats */
  int32_t codes;
} cs_mip_levels_decoder;

/* Whether opaque pixels are codes of 8-bit sRGB. */
static inline bool cs_mip_levels_is_srgb8(const cs_mip_levels_decoder *decoder) {
  return decoder->table && !decoder->is_linear && !decoder->has_matrix && decoder->codes == 255 &&
         decoder->transfer == CELSPAN_TRANSFER_SRGB;
}

/* Coded RGBA to linear light, premultiplied, in place. The result has no NaN and nothing beyond the
 * largest half float, and alpha is in 0..1. */
void cs_mip_levels_decode(const cs_mip_levels_decoder *decoder, float *rgba, size_t count);
