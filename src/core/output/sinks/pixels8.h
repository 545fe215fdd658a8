/* Rows of 8 bits, sRGB, straight alpha: nearly every frame is written in this form. */
#pragma once

#include <stddef.h>

#include "base/wide.h"
#include "celspan/celspan.h"
#include "model/colour/srgb8_lanes.h"

/* spans: at least one; they cover [0, width) without gap. Their numbers are linear. */
CS_WIDE_DECLARE(void, cs_pixels8_row,
                (const celspan_span *spans, size_t count, unsigned char *row));
/* The same for spans whose numbers are codes. */
CS_WIDE_DECLARE(void, cs_pixels8_codes,
                (const celspan_span *spans, size_t count, unsigned char *row));

/* A register of columns from x on of a gradient, also beyond its end: for kernels (base/wide.h). */
static inline cs_srgb8_planes cs_pixels8_columns(const celspan_span *span, int32_t x) {
  cs_wide numbers;
  cs_srgb8_planes colours;
  for (int i = 0; i < CS_WIDE_LANES; i++)
    numbers[i] = (float)i;
  for (int c = 0; c < 4; c++)
    colours.channels[c] = span->colour[c] + span->slope[c] * (numbers + (float)(x - span->origin));
  return colours;
}

/* Runs of one pixel, filled in chunks of 64 bytes: for kernels (base/wide.h).
 *
 *   cache lines   |        |        |        |        |
 *   run              xxxxxxxxxxxxxxxxxxxxxxxxx
 *   chunks           [ first ]                            at the run's start
 *                          [       ][       ]             on cache lines
 *                                      [ last  ]          at the run's end
 *
 * Chunks overlap at both ends, which is harmless because every chunk has the same bytes. A chunk
 * inside lies on a cache line, which halves its cost, provided that this is a whole number of
 * pixels away from the row's start. In general it begins at an address that is `phase` modulo a
 * chunk, where phase is the row's address modulo the size of a pixel; so it begins with a whole
 * pixel.
 */

enum { CS_FILL_CHUNK = 64 };

/* pattern: the pixel, repeated to fill a register. */
static inline void cs_fill_store(unsigned char *out, cs_wide_int pattern) {
  for (size_t at = 0; at < CS_FILL_CHUNK; at += sizeof pattern)
    memcpy(out + at, &pattern, sizeof pattern);
}

/* Fills a run except for its first chunk; up to a chunk after its end may be overwritten. */
static inline void cs_fill_lines(unsigned char *out, const unsigned char *end, cs_wide_int pattern,
                                 uintptr_t phase) {
  out += CS_FILL_CHUNK - ((uintptr_t)out - phase) % CS_FILL_CHUNK;
  for (; out < end; out += CS_FILL_CHUNK)
    cs_fill_store(out, pattern);
}

/* Fills a run and writes nothing beyond it. */
static inline void cs_fill_exactly(unsigned char *out, unsigned char *end, cs_wide_int pattern,
                                   uintptr_t phase) {
  unsigned char chunk[CS_FILL_CHUNK];
  if (end - out < CS_FILL_CHUNK) {
    cs_fill_store(chunk, pattern);
    memcpy(out, chunk, (size_t)(end - out));
    return;
  }
  cs_fill_store(out, pattern);
  cs_fill_lines(out, end - CS_FILL_CHUNK, pattern, phase);
  cs_fill_store(end - CS_FILL_CHUNK, pattern);
}

/* ---- pixels8_wide.c */

/* Repeats a pixel of `pixel_size` bytes (1, 2, 4, 8 or 16) over `size` bytes, a multiple of
 * pixel_size. */
CS_WIDE_DECLARE(void, cs_fill_run,
                (unsigned char *out, size_t size, const unsigned char *pixel, size_t pixel_size));
