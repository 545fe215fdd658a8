#include "pictures/levels.h"

#include "base/number.h"
#include "colour/transfer.h"

#define LARGEST 65504.0f

int cs_levels_count(int32_t width, int32_t height) {
  int32_t side = width > height ? width : height;
  int count = 1;
  while (cs_levels_size(side, count - 1) > 1)
    count++;
  return count;
}

/* The share of the second of two texels, by the pixels they cover. */
static float second_share(int32_t size, int level, int32_t first) {
  int64_t side = (int64_t)1 << level;
  int64_t left = (int64_t)size - (int64_t)(first + 1) * side;
  if (left <= 0)
    return 0;
  return left >= side ? 0.5f : (float)((double)left / (double)(side + left));
}

static void mix(const float *a, const float *b, float share, float out[4]) {
  for (int c = 0; c < 4; c++)
    out[c] = a[c] + share * (b[c] - a[c]);
}

void cs_levels_mean(int32_t width, int32_t height, int level, int32_t x, int32_t y, int32_t count,
                    const float *upper, const float *lower, float *out) {
  float down = lower ? second_share(height, level, y) : 0;
  if (!lower)
    lower = upper;
  for (int32_t i = 0; i < count; i += 2) {
    bool is_last = i + 2 >= count;
    float across = is_last ? (i + 1 < count ? second_share(width, level, x + i) : 0) : 0.5f;
    size_t at = 4 * (size_t)i, next = i + 1 < count ? at + 4 : at;
    float above[4], below[4];
    mix(upper + at, upper + next, across, above);
    mix(lower + at, lower + next, across, below);
    mix(above, below, down, out + 2 * (size_t)i);
  }
}

static float clean(float v) { return v != v ? 0.0f : cs_number_clampf(v, -LARGEST, LARGEST); }

static float to_light(const cs_levels_decoder *decoder, float coded) {
  if (!decoder->table)
    return cs_transfer_decode(decoder->transfer, clean(coded));
  int32_t code = cs_number_to_int32((double)coded * decoder->codes + 0.5);
  return decoder->table[code < 0 ? 0 : code > decoder->codes ? decoder->codes : code];
}

/* Coded colour was multiplied by alpha: divided, decoded, multiplied again. Colour under no alpha
 * says nothing of what it was. */
static float to_light_divided(const cs_levels_decoder *decoder, float coded, float alpha) {
  if (alpha >= 1)
    return to_light(decoder, coded);
  if (alpha <= 0)
    return 0;
  float straight = clean(coded) / alpha;
  return cs_transfer_decode(decoder->transfer,
                            decoder->table ? cs_number_clampf(straight, 0, 1) : straight);
}

static void decode_pixel(const cs_levels_decoder *decoder, float *rgba) {
  float alpha = cs_number_clampf(clean(rgba[3]), 0, 1);
  /* Linear light may shine where alpha is 0. */
  bool is_light = decoder->is_linear || (decoder->alpha == CS_PICTURE_ALPHA_CODED &&
                                         decoder->transfer == CELSPAN_TRANSFER_LINEAR);
  for (int c = 0; c < 3; c++) {
    float light = is_light ? rgba[c]
                  : decoder->alpha == CS_PICTURE_ALPHA_CODED
                      ? to_light_divided(decoder, rgba[c], alpha) * alpha
                      : to_light(decoder, rgba[c]) * alpha;
    rgba[c] = clean(light);
  }
  rgba[3] = alpha;
}

void cs_levels_decode(const cs_levels_decoder *decoder, float *rgba, size_t count) {
  for (size_t i = 0; i < count; i++)
    decode_pixel(decoder, rgba + 4 * i);
}
