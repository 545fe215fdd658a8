/* Filters over the bytes of PNG rows (PNG 3rd edition, 9). A filter predicts each byte x from its
 * neighbours of the same channel and stores the difference:
 *
 *   row above      c  b          Sub x - a     Average x - floor((a + b) / 2)
 *   row            a  x          Up  x - b     Paeth   x - the one nearest to a + b - c
 *
 *   in memory   | zeros: a pixel | bytes of the row | zeros: CS_PNG_BATCH |
 *
 * INVARIANT: a kernel gives the same bytes for every set of instructions. Less than CS_PNG_BATCH
 * bytes beyond the end of the output may be overwritten.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/wide.h"

enum {
  CS_PNG_BATCH = 64,                   /* bytes; a multiple of the size of every register */
  CS_PNG_COST_MOST = 56 * CS_PNG_BATCH /* the most bytes for one call: its sums have 16 bits */
};

/* In the order of their numbers in the file. */
typedef enum cs_png_filter {
  CS_PNG_NONE,
  CS_PNG_SUB,
  CS_PNG_UP,
  CS_PNG_AVERAGE,
  CS_PNG_PAETH,
  CS_PNG_FILTERS
} cs_png_filter;

/* The differences of `size` bytes of a row under a filter. */
CS_WIDE_DECLARE(void, cs_png_bytes_filter,
                (cs_png_filter kind, const unsigned char *row, const unsigned char *above,
                 size_t pixel_size, size_t size, unsigned char *out));
/* Adds to each filter's cost the magnitudes of the differences as signed bytes, and CS_PNG_NOT_ZERO
 * for each difference other than 0. Magnitudes alone, the usual estimate, undervalue the long runs
 * of zeros in drawn pictures. size: at most CS_PNG_COST_MOST. */
enum { CS_PNG_NOT_ZERO = 16 };
CS_WIDE_DECLARE(void, cs_png_bytes_add_costs,
                (const unsigned char *row, const unsigned char *above, size_t pixel_size,
                 size_t size, uint64_t costs[CS_PNG_FILTERS]));
/* Removes the alpha of 8-bit pixels, in place. Returns the bits that are set in all of them. */
CS_WIDE_DECLARE(uint32_t, cs_png_bytes_drop_alpha, (unsigned char *bytes, size_t pixel_count));
