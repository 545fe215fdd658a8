/* Dithering as a rounding of the coder of srgb8_lanes.h: where the others add a half before they
 * cut a number to a whole one, here each pixel has a lift of its own.
 *
 *   colours --cs_srgb8_numbers--> y of 0..255 --(+ lift)--> floor
 *                                                 unsure, as one pixel in six hundred: exact_pixel
 *
 * The narrowest make has the exact numbers, so that nothing is unsure.
 */
#include <string.h>

#include "model/colour/srgb8_lanes.h"
#include "output/sinks/dither.h"
#include "output/sinks/pixels.h"

typedef struct dithered {
  const celspan_coding *coding;
  const cs_dither_lifts *lifts;
  bool is_coded, is_straight;
} dithered;

/* ---------------------------------------------------------------- numbers and rounding */

static inline unsigned char round_lifted(float x, float lift) {
  return !(x > 0) ? 0 : x >= 1 ? 255 : (unsigned char)((double)x * 255 + (double)lift);
}

static inline void exact_pixel(const float coded[4], const float lift[4], unsigned char *pixel) {
  for (int c = 0; c < 4; c++)
    pixel[c] = round_lifted(coded[c], lift[c]);
}

#ifdef __AVX2__

/* The numbers that are rounded: 0..255. */
static inline cs_wide numbers_of(const dithered *d, cs_wide rgba) {
  return cs_srgb8_numbers(d->is_straight ? cs_srgb8_straight(rgba) : cs_srgb8_clamped(rgba),
                          d->is_coded);
}

/* Codes the pixels that have an unsure lane (a set bit) again. */
static void settle(const dithered *d, cs_wide rgba, const float (*lifts)[4], unsigned unsure,
                   unsigned char *out) {
  float colours[CS_WIDE_LANES], coded[4];
  cs_wide_store(colours, rgba);
  for (int k = 0; k < CS_SRGB8_PIXELS; k++, unsure >>= 4)
    if (unsure & 15) {
      cs_pixels_encode(d->coding, colours + 4 * k, coded);
      exact_pixel(coded, lifts[k], out + 4 * k);
    }
}

static inline void put_pixels(const dithered *d, cs_wide rgba, cs_wide numbers,
                              const float (*lifts)[4], unsigned char *out) {
  cs_wide_int doubt = {0}, none = {0};
  cs_srgb8_store(out, cs_srgb8_lifted(numbers, cs_wide_load(lifts[0]), &doubt));
  unsigned unsure = cs_srgb8_differ(doubt, none);
  if (__builtin_expect(unsure != 0, 0))
    settle(d, rgba, lifts, unsure, out);
}

#else

/* The numbers that are rounded: exact numbers of 0..1. */
static inline cs_wide numbers_of(const dithered *d, cs_wide rgba) {
  float colour[4], coded[4];
  cs_wide_store(colour, rgba);
  cs_pixels_encode(d->coding, colour, coded);
  return cs_wide_load(coded);
}

static inline void put_pixels(const dithered *d, cs_wide rgba, cs_wide numbers,
                              const float (*lifts)[4], unsigned char *out) {
  float coded[4];
  (void)d, (void)rgba;
  cs_wide_store(coded, numbers);
  exact_pixel(coded, lifts[0], out);
}

#endif

/* ---------------------------------------------------------------- spans */

/* Pixels of one colour: all of them, or one period, which is repeated. x: the place of the first
 * one. */
static inline void put_single(const dithered *d, const celspan_span *span, uint32_t x,
                              unsigned char *out) {
  unsigned char period[4 * CS_DITHER_PERIOD + CS_WIDE_LANES];
  const float(*lifts)[4] = d->lifts->of + x % CS_DITHER_PERIOD;
  cs_wide rgba = cs_wide_pixel(span->colour), numbers = numbers_of(d, rgba);
  size_t rest = 4 * (size_t)(span->x1 - span->x0), size = 4 * CS_DITHER_PERIOD;
  for (size_t at = 0; at < size && at < rest; at += CS_WIDE_LANES)
    put_pixels(d, rgba, numbers, lifts + at / 4, period + at);
  for (; rest > size; rest -= size, out += size)
    memcpy(out, period, size);
  memcpy(out, period, rest);
}

/* At most a register of columns, `count` from x on, of a span whose colours vary. */
static inline cs_wide colours_of(const celspan_span *span, int32_t x, size_t count) {
  float last[CS_WIDE_LANES] = {0};
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    return cs_wide_pixel(span->colour) +
           cs_wide_pixel(span->slope) * (cs_wide_pixel_numbers() + (float)(x - span->origin));
  const float *rgba = span->array + 4 * (size_t)(x - span->x0);
  if (count == CS_SRGB8_PIXELS)
    return cs_wide_load(rgba);
  memcpy(last, rgba, 4 * count * sizeof *rgba);
  return cs_wide_load(last);
}

static inline void put_varied(const dithered *d, const celspan_span *span, uint32_t place,
                              unsigned char *out) {
  for (int32_t x = span->x0; x < span->x1; x += CS_SRGB8_PIXELS, place += CS_SRGB8_PIXELS) {
    size_t rest = (size_t)(span->x1 - x), count = rest < CS_SRGB8_PIXELS ? rest : CS_SRGB8_PIXELS;
    unsigned char pixels[CS_WIDE_LANES];
    cs_wide rgba = colours_of(span, x, count);
    put_pixels(d, rgba, numbers_of(d, rgba), d->lifts->of + place % CS_DITHER_PERIOD, pixels);
    memcpy(out, pixels, 4 * count);
    out += 4 * count;
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
      put_single(&d, span, place, out);
    else
      put_varied(&d, span, place, out);
  }
}
