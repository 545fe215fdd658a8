#include "model/pictures/mip_levels.h"

#include <string.h>

#include "base/number.h"
#include "model/colour/transfer.h"

#define LARGEST 65504.0f

int cs_mip_levels_count(int32_t width, int32_t height) {
  int32_t side = width > height ? width : height;
  int count = 1;
  while (cs_mip_levels_size(side, count - 1) > 1)
    count++;
  return count;
}

/* The weight of the second of two neighbours in their mean: each neighbour is weighted by its
 * number of pixels. */
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

void cs_mip_levels_mean(const cs_mip_level *from, const cs_mip_rows *rows, float *out) {
  const float *upper = rows->upper, *lower = rows->lower ? rows->lower : rows->upper;
  float down = rows->lower ? second_share(from->height, from->level, rows->y) : 0;
  for (int32_t i = 0; i < rows->count; i += 2) {
    bool has_next = i + 1 < rows->count, is_last = i + 2 >= rows->count;
    float across = !is_last   ? 0.5f
                   : has_next ? second_share(from->width, from->level, rows->x + i)
                              : 0;
    size_t at = 4 * (size_t)i, next = has_next ? at + 4 : at;
    float above[4], below[4];
    mix(upper + at, upper + next, across, above);
    mix(lower + at, lower + next, across, below);
    mix(above, below, down, out + 2 * (size_t)i);
  }
}

static float clean(float v) { return v != v ? 0.0f : cs_number_clampf(v, -LARGEST, LARGEST); }

static float to_light(const cs_mip_levels_decoder *decoder, float coded) {
  if (!decoder->table)
    return cs_transfer_decode(decoder->transfer, clean(coded));
  int32_t code = cs_number_to_int32((double)coded * decoder->codes + 0.5);
  return decoder->table[code < 0 ? 0 : code > decoder->codes ? decoder->codes : code];
}

/* A colour that was coded and then multiplied by alpha has to be divided by alpha before it is
 * decoded. Where alpha is 0 the colour is lost. */
static float to_light_divided(const cs_mip_levels_decoder *decoder, float coded, float alpha) {
  if (alpha >= 1)
    return to_light(decoder, coded);
  if (alpha <= 0)
    return 0;
  float straight = clean(coded) / alpha;
  return cs_transfer_decode(decoder->transfer,
                            decoder->table ? cs_number_clampf(straight, 0, 1) : straight);
}

static void change_primaries(const double m[9], float rgba[3]) {
  const double r = (double)rgba[0], g = (double)rgba[1], b = (double)rgba[2];
  for (int c = 0; c < 3; c++)
    rgba[c] = clean((float)(m[3 * c] * r + m[3 * c + 1] * g + m[3 * c + 2] * b));
}

static void decode_pixel(const cs_mip_levels_decoder *decoder, float *rgba) {
  float alpha = cs_number_clampf(clean(rgba[3]), 0, 1);
  /* In linear light a colour with alpha 0 is a glow, and is kept. */
  bool is_light = decoder->is_linear || (decoder->alpha == CS_PICTURE_ALPHA_CODED &&
                                         decoder->transfer == CELSPAN_TRANSFER_LINEAR);
  for (int c = 0; c < 3; c++) {
    float light = is_light ? rgba[c]
                  : decoder->alpha == CS_PICTURE_ALPHA_CODED
                      ? to_light_divided(decoder, rgba[c], alpha) * alpha
                      : to_light(decoder, rgba[c]) * alpha;
    rgba[c] = clean(light);
  }
  if (decoder->has_matrix)
    change_primaries(decoder->matrix, rgba);
  rgba[3] = alpha;
}

/* The same, for pixels whose numbers are codes, and whose colours are not multiplied. */
static void decode_codes(const cs_mip_levels_decoder *decoder, float *rgba, size_t count) {
  const float *table = decoder->table;
  const double most = decoder->codes;
  for (size_t i = 0; i < count; i++, rgba += 4) {
    float alpha = cs_number_clampf(clean(rgba[3]), 0, 1);
    for (int c = 0; c < 3; c++) {
      double code = (double)rgba[c] * most + 0.5;
      rgba[c] = table[code > 0 ? (int32_t)(code < most ? code : most) : 0] * alpha;
    }
    rgba[3] = alpha;
  }
}

/* In drawings most pixels equal the pixel before them. */
void cs_mip_levels_decode(const cs_mip_levels_decoder *decoder, float *rgba, size_t count) {
  float coded[4], light[4];
  if (decoder->table && !decoder->is_linear && !decoder->has_matrix &&
      decoder->alpha == CS_PICTURE_ALPHA_STRAIGHT) {
    decode_codes(decoder, rgba, count);
    return;
  }
  for (size_t i = 0; i < count; i++, rgba += 4) {
    if (i > 0 && memcmp(rgba, coded, sizeof coded) == 0) {
      memcpy(rgba, light, sizeof light);
      continue;
    }
    memcpy(coded, rgba, sizeof coded);
    decode_pixel(decoder, rgba);
    memcpy(light, rgba, sizeof light);
  }
}
