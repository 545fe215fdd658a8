/* Runs of one pixel in blocks at the width of the machine's stores: for kernels (base/wide.h).
 *
 * Blocks lie on the lines of the cache where that can be, which halves their cost: at addresses
 * that are `phase` modulo a block. Phase is the row's address modulo the size of a pixel, so a
 * block begins with a whole pixel.
 */
#ifndef CS_OUTPUT_FILL_H
#define CS_OUTPUT_FILL_H

#include "base/wide.h"
#include <stddef.h>

enum { CS_FILL_BLOCK = 64 };

/* part: pixels as far as a register goes, which a block repeats. */
static inline void cs_fill_store(unsigned char *out, cs_wide_int part) {
  for (size_t at = 0; at < CS_FILL_BLOCK; at += sizeof part)
    memcpy(out + at, &part, sizeof part);
}

/* All of a run but the block it begins with; up to a block beyond the end is written. */
static inline void cs_fill_lines(unsigned char *out, const unsigned char *end, cs_wide_int part,
                                 uintptr_t phase) {
  out += CS_FILL_BLOCK - ((uintptr_t)out - phase) % CS_FILL_BLOCK;
  for (; out < end; out += CS_FILL_BLOCK)
    cs_fill_store(out, part);
}

/* A run, and nothing beyond it. */
static inline void cs_fill_exactly(unsigned char *out, unsigned char *end, cs_wide_int part,
                                   uintptr_t phase) {
  unsigned char block[CS_FILL_BLOCK];
  if (end - out < CS_FILL_BLOCK) {
    cs_fill_store(block, part);
    memcpy(out, block, (size_t)(end - out));
    return;
  }
  cs_fill_store(out, part);
  cs_fill_lines(out, end - CS_FILL_BLOCK, part, phase);
  cs_fill_store(end - CS_FILL_BLOCK, part);
}

/* ---- fill_wide.c */

/* Repeats a pixel of `pixel_size` bytes, 1, 2, 4, 8 or 16, over `size` bytes, a multiple of it. */
CS_WIDE_DECLARE(void, cs_fill_run,
                (unsigned char *out, size_t size, const unsigned char *pixel, size_t pixel_size));

#endif
