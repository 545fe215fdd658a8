/* Dithering: 8-bit numbers rounded up or down by the place of their pixel, so that the mean of a
 * flat field keeps the fraction that rounding would lose, and gradients show no bands.
 *
 *   a channel at 100.25 of 255, pixel by pixel           thresholds of 2 x 2 pixels (here 16 x 16)
 *
 *     100 100 101 100 100 100 101 100                       1/8  5/8
 *     100 100 100 100 100 100 100 100                       7/8  3/8
 *
 * Invariants: a pixel's bytes depend on its colour and its place in the whole frame alone, so
 * crops, strips and workers change nothing. A number that is exact in 8 bits does not change. Over
 * 16 x 16 pixels of one colour the mean is within 1/130560 (half of 1/256 of 1/255) of the colour.
 */
#pragma once

#include "base/context.h"
#include "base/wide.h"
#include "celspan/celspan.h"

/* Codes the spans of a row, which cover [0, width) without gap. x, y: the place of its first pixel
 * in the whole frame. coding: resolved, of 8 bits. Any thread. */
void cs_dither_row(const celspan_coding *coding, int32_t x, int32_t y, const celspan_span *spans,
                   size_t span_count, unsigned char *row);

/* ---- dither_wide.c */

enum { CS_DITHER_PERIOD = 16 }; /* pixels after which thresholds repeat, along x and along y */

/* What is added to a number before its fraction is cut off: 1 minus the threshold of the place, for
 * two periods of pixels along a row. */
typedef struct cs_dither_lifts {
  float of[2 * CS_DITHER_PERIOD];
} cs_dither_lifts;

/* As cs_dither_row, where pixel x of a row has lift x modulo the period. The version for the
 * narrowest registers is exact for every coding; the others support only sRGB, straight or
 * premultiplied. */
CS_WIDE_DECLARE(void, cs_dither_spans,
                (const celspan_coding *coding, const cs_dither_lifts *lifts, int32_t x,
                 const celspan_span *spans, size_t span_count, unsigned char *row));
