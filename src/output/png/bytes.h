/* Kernels over rows of bytes of a PNG.
 *
 * Invariant: each make of a kernel gives the same bytes. Rows have a pixel of zeros before their
 * first byte and CS_PNG_BLOCK zeros after their last; what is written may go on for less than
 * CS_PNG_BLOCK bytes.
 */
#ifndef CS_OUTPUT_PNG_BYTES_H
#define CS_OUTPUT_PNG_BYTES_H

#include <stddef.h>
#include <stdint.h>

#include "base/wide.h"

enum {
  CS_PNG_BLOCK = 64,
  CS_PNG_COST_MOST = 56 * CS_PNG_BLOCK /* bytes whose cost is told at once: sums have 16 bits */
};

/* By their numbers in the file. */
typedef enum cs_png_filter {
  CS_PNG_NONE,
  CS_PNG_SUB,
  CS_PNG_UP,
  CS_PNG_AVERAGE,
  CS_PNG_PAETH,
  CS_PNG_FILTERS
} cs_png_filter;

/* What `size` bytes of a row leave under a filter. */
CS_WIDE_DECLARE(void, cs_png_filter_part,
                (cs_png_filter kind, const unsigned char *row, const unsigned char *above,
                 size_t pixel_size, size_t size, unsigned char *out));
/* Adds to each filter's cost: of a residue its size as a signed byte, and CS_PNG_NOT_ZERO unless it
 * is 0. Sizes alone, the usual guess, think little of the long runs of zeros of drawn pictures. */
enum { CS_PNG_NOT_ZERO = 16 };
CS_WIDE_DECLARE(void, cs_png_add_costs,
                (const unsigned char *row, const unsigned char *above, size_t pixel_size,
                 size_t size, uint64_t costs[CS_PNG_FILTERS]));
/* Leaves out the alpha of 8-bit pixels, in place; the bits that all of them have. */
CS_WIDE_DECLARE(uint32_t, cs_png_drop_alpha, (unsigned char *bytes, size_t pixel_count));

#endif
