/* Dithering as a rounding of the coder of srgb8_lanes.h: where the others add a half before they
 * cut a number to a whole one, here each pixel has a lift of its own. A register has one channel of
 * as many pixels as it has lanes, and another register has their lifts, as they lie in the row.
 *
 *   colours --cs_srgb8_lift_planes--> whole part of y + lift, for y of 0..255
 *                                 unsure, as one number in two thousand: exact_pixel
 *
 * The narrowest make codes every pixel exactly.
 */
#include <string.h>

#include "model/colour/srgb8_lanes.h"
#include "output/sinks/dither.h"
#include "output/sinks/pixels.h"
#include "output/sinks/pixels8.h"

typedef struct dithered {
  const celspan_coding *coding;
  const cs_dither_lifts *lifts;
  bool is_coded, is_straight;
} dithered;

/* ---------------------------------------------------------------- exactly */

static inline unsigned char round_lifted(float x, float lift) {
  return !(x > 0) ? 0 : x >= 1 ? 255 : (unsigned char)((double)x * 255 + (double)lift);
}

static inline int32_t exact_pixel(const float coded[4], float lift) {
  unsigned char bytes[4];
  int32_t pixel;
  for (int c = 0; c < 4; c++)
    bytes[c] = round_lifted(coded[c], lift);
  memcpy(&pixel, bytes, sizeof pixel);
  return pixel;
}

/* A register of pixels of one colour. */
static cs_wide_int exact_single(const float coded[4], const float *lifts) {
  cs_wide_int pixels = {0};
  for (int k = 0; k < CS_WIDE_LANES; k++)
    pixels[k] = exact_pixel(coded, lifts[k]);
  return pixels;
}

/* Codes the pixels that have an unsure lane (a set bit) again. */
static cs_wide_int settle(const dithered *d, const cs_srgb8_planes *colours, const float *lifts,
                          unsigned unsure, cs_wide_int pixels) {
  for (int k = 0; unsure != 0; k++, unsure >>= 1) {
    float coded[4], rgba[4];
    if (!(unsure & 1))
      continue;
    for (int c = 0; c < 4; c++)
      rgba[c] = colours->channels[c][k];
    cs_pixels_encode(d->coding, rgba, coded);
    pixels[k] = exact_pixel(coded, lifts[k]);
  }
  return pixels;
}

/* ---------------------------------------------------------------- a register of pixels */

#ifdef __AVX2__

/* Numbers of a colour for lift_single: 0..255. */
static inline void numbers_of(const dithered *d, const float rgba[4],
                              float numbers[CS_WIDE_LANES]) {
  cs_wide v = cs_wide_pixel(rgba);
  v = d->is_straight ? cs_srgb8_straight(v) : cs_srgb8_clamped(v);
  cs_wide_store(numbers, cs_srgb8_numbers(v, d->is_coded));
}

/* Pixels of one colour. */
static inline cs_wide_int lift_single(const dithered *d, const float rgba[4], const float *numbers,
                                      const float *lifts) {
  const cs_wide_int none = {0};
  cs_wide_int pixels = none, doubt = none;
  for (int c = 3; c >= 0; c--)
    pixels = pixels << 8 | cs_srgb8_lifted(cs_wide_all(numbers[c]), cs_wide_load(lifts), &doubt);
  if (__builtin_expect(cs_srgb8_differ(doubt, none) != 0, 0)) {
    float coded[4];
    cs_pixels_encode(d->coding, rgba, coded);
    return exact_single(coded, lifts);
  }
  return pixels;
}

/* Pixels of several colours, of which the first `count` are needed. */
static inline cs_wide_int lift_planes(const dithered *d, const cs_srgb8_planes *colours,
                                      const float *lifts, int32_t count) {
  unsigned unsure;
  cs_wide_int pixels =
      cs_srgb8_lift_planes(colours, d->is_coded, d->is_straight, cs_wide_load(lifts), &unsure);
  unsure &= (1u << count) - 1;
  return __builtin_expect(unsure != 0, 0) ? settle(d, colours, lifts, unsure, pixels) : pixels;
}

#else

static inline void numbers_of(const dithered *d, const float rgba[4],
                              float numbers[CS_WIDE_LANES]) {
  cs_pixels_encode(d->coding, rgba, numbers);
}

static inline cs_wide_int lift_single(const dithered *d, const float rgba[4], const float *numbers,
                                      const float *lifts) {
  (void)d, (void)rgba;
  return exact_single(numbers, lifts);
}

static inline cs_wide_int lift_planes(const dithered *d, const cs_srgb8_planes *colours,
                                      const float *lifts, int32_t count) {
  return settle(d, colours, lifts, (1u << count) - 1, (cs_wide_int){0});
}

#endif

/* ---------------------------------------------------------------- spans */

/* Pixels of one colour: all of them, or one period, which is repeated. lifts: from the first one
 * on. */
static inline void put_single(const dithered *d, const celspan_span *span, const float *lifts,
                              unsigned char *out) {
  cs_wide_int period[CS_DITHER_PERIOD / CS_WIDE_LANES];
  float numbers[CS_WIDE_LANES];
  size_t rest = 4 * (size_t)(span->x1 - span->x0), size = sizeof period;
  numbers_of(d, span->colour, numbers);
  for (size_t at = 0; at < size && at < rest; at += sizeof *period)
    period[at / sizeof *period] = lift_single(d, span->colour, numbers, lifts + at / 4);
  for (; rest > size; rest -= size, out += size)
    memcpy(out, period, size);
  memcpy(out, period, rest);
}

/* At most a register of columns, `count` from x on, of a span whose colours vary. */
static inline cs_srgb8_planes colours_of(const celspan_span *span, int32_t x, int32_t count) {
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    return cs_pixels8_columns(span, x);
  const float *rgba = span->array + 4 * (size_t)(x - span->x0);
  if (count == CS_WIDE_LANES)
    return cs_srgb8_planes_of(rgba, 4);
  float last[4 * CS_WIDE_LANES] = {0};
  memcpy(last, rgba, 4 * (size_t)count * sizeof *rgba);
  return cs_srgb8_planes_of(last, 4);
}

static inline void put_varied(const dithered *d, const celspan_span *span, uint32_t place,
                              unsigned char *out) {
  for (int32_t x = span->x0; x < span->x1; x += CS_WIDE_LANES, place += CS_WIDE_LANES) {
    int32_t rest = span->x1 - x, count = rest < CS_WIDE_LANES ? rest : CS_WIDE_LANES;
    const cs_srgb8_planes colours = colours_of(span, x, count);
    const cs_wide_int pixels =
        lift_planes(d, &colours, d->lifts->of + place % CS_DITHER_PERIOD, count);
    memcpy(out, &pixels, 4 * (size_t)count);
    out += sizeof pixels;
  }
}

void CS_WIDE(cs_dither_spans)(const celspan_coding *coding, const cs_dither_lifts *lifts, int32_t x,
                              const celspan_span *spans, size_t span_count, unsigned char *row) {
  const dithered d = {.coding = coding,
                      .lifts = lifts,
                      .is_coded = coding->space == CELSPAN_SPACE_SRGB,
                      .is_straight = coding->alpha == CELSPAN_ALPHA_STRAIGHT};
  for (const celspan_span *span = spans; span < spans + span_count; span++) {
    unsigned char *out = row + 4 * (size_t)span->x0;
    uint32_t place = (uint32_t)x + (uint32_t)span->x0;
    if (span->kind == CELSPAN_SPAN_SINGLE)
      put_single(&d, span, lifts->of + place % CS_DITHER_PERIOD, out);
    else
      put_varied(&d, span, place, out);
  }
}
