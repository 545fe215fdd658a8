#include "output/sinks/dither.h"

/* Bayer's thresholds: (2 k + 1)/512 for a k of 0..255, each once in 16 x 16 pixels. k consists of
 * alternate bits of x ^ y and of y, the lowest first, so that the thresholds of neighbours differ
 * much. */
static float threshold(uint32_t x, uint32_t y) {
  uint32_t k = 0, mixed = x ^ y;
  for (int bit = 0; bit < 4; bit++)
    k = k << 2 | (mixed >> bit & 1) << 1 | (y >> bit & 1);
  return (float)(2 * k + 1) / 512;
}

/* Whether the vectorized functions support the coding. */
static bool is_usual(const celspan_coding *coding) {
  return coding->transfer == CELSPAN_TRANSFER_SRGB && coding->alpha <= CELSPAN_ALPHA_PREMULTIPLIED;
}

void cs_dither_row(const celspan_coding *coding, int32_t x, int32_t y, const celspan_span *spans,
                   size_t span_count, unsigned char *row) {
  cs_dither_lifts lifts;
  for (uint32_t i = 0; i < CS_DITHER_PERIOD; i++)
    lifts.of[i] = lifts.of[i + CS_DITHER_PERIOD] = 1 - threshold(i, (uint32_t)y);
  cs_isa isa = is_usual(coding) ? cs_isa_best() : CS_ISA_ANY;
  CS_WIDE_CHOOSE(isa, cs_dither_spans)(coding, &lifts, x, spans, span_count, row);
}
