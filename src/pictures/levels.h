/* The arithmetic of pictures: from coded pixels to light, and from one mip level to the next.
 *
 * Level k has ceil(size / 2^k) texels a side; texel i of it is the mean, in linear light and
 * premultiplied, of the picture's pixels [i 2^k, (i+1) 2^k) that exist. Every texel is a function
 * of the four below it alone, so the bits do not depend on how a level came to be.
 */
#ifndef CS_PICTURES_LEVELS_H
#define CS_PICTURES_LEVELS_H

#include "pictures/module.h"

/* Texels along an axis of `size` pixels at `level`. */
static inline int32_t cs_levels_size(int32_t size, int level) {
  return (int32_t)(((int64_t)size + ((int64_t)1 << level) - 1) >> level);
}

/* Levels until one texel is left, level 0 included. */
int cs_levels_count(int32_t width, int32_t height);

/* A row of level + 1 from one or two of `level`. upper: texels x .. x+count-1 of row y, both even;
 * lower: of row y + 1, NULL when there is none. width, height: of the picture, in pixels.
 * out: (count + 1) / 2 texels; may be upper. */
void cs_levels_mean(int32_t width, int32_t height, int level, int32_t x, int32_t y, int32_t count,
                    const float *upper, const float *lower, float *out);

typedef struct cs_levels_decoder {
  celspan_transfer transfer;
  cs_picture_alpha alpha;
  bool is_linear;
  const float *table; /* linear light by code, NULL for floats */
  int32_t codes;
} cs_levels_decoder;

/* RGBA as coded to linear premultiplied, in place. No NaN comes out, nothing beyond the largest
 * half float, and alpha is in 0..1. */
void cs_levels_decode(const cs_levels_decoder *decoder, float *rgba, size_t count);

#endif
