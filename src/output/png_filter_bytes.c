#include "output/png_filter.h"

#include <string.h>

enum { BLOCK = CS_PNG_BLOCK, SCRATCH = 255 * BLOCK };
typedef uint8_t bytes __attribute__((vector_size(BLOCK)));
typedef uint16_t words __attribute__((vector_size(BLOCK)));

static inline bytes load_block(const unsigned char *at) {
  bytes block;
  memcpy(&block, at, sizeof block);
  return block;
}

static inline bytes select(bytes condition, bytes yes, bytes no) {
  return (yes & condition) | (no & ~condition);
}

/* Of a, b and c the one nearest to a + b - c; a before b before c. Its distance to c is that of a
 * and that of b apart, when c is between them; else it is no less than both, and c is not taken. */
static inline bytes paeth(bytes a, bytes b, bytes c) {
  bytes a_is_less = (bytes)(a <= c), b_is_less = (bytes)(b <= c);
  bytes from_b = select(a_is_less, c - a, a - c), from_a = select(b_is_less, c - b, b - c);
  bytes a_is_nearer = (bytes)(from_a <= from_b);
  bytes apart = select(a_is_nearer, from_b - from_a, from_a - from_b);
  bytes from_c = apart | (bytes)(a_is_less == b_is_less);
  bytes b_or_c = select((bytes)(from_b <= from_c), b, c);
  return select(a_is_nearer & (bytes)(from_a <= from_c), a, b_or_c);
}

/* What is left of a block of a row under a filter. */
static inline bytes residue(cs_png_filter kind, const unsigned char *row,
                            const unsigned char *above, size_t pixel_size) {
  bytes x = load_block(row), a = load_block(row - pixel_size), b = load_block(above);
  switch (kind) {
  case CS_PNG_NONE:
    return x;
  case CS_PNG_SUB:
    return x - a;
  case CS_PNG_UP:
    return x - b;
  case CS_PNG_AVERAGE:
    return x - ((a & b) + ((a ^ b) >> 1));
  case CS_PNG_PAETH:
    return x - paeth(a, b, load_block(above - pixel_size));
  }
  return x;
}

static inline void filter_as(cs_png_filter kind, const unsigned char *row,
                             const unsigned char *above, size_t pixel_size, size_t size,
                             unsigned char *out) {
  for (size_t i = 0; i < size; i += BLOCK) {
    bytes block = residue(kind, row + i, above + i, pixel_size);
    memcpy(out + i, &block, sizeof block);
  }
}

/* Size is rounded up to whole blocks. */
static void filter_part(cs_png_filter kind, const unsigned char *row, const unsigned char *above,
                        size_t pixel_size, size_t size, unsigned char *out) {
  switch (kind) {
  case CS_PNG_NONE:
    filter_as(CS_PNG_NONE, row, above, pixel_size, size, out);
    break;
  case CS_PNG_SUB:
    filter_as(CS_PNG_SUB, row, above, pixel_size, size, out);
    break;
  case CS_PNG_UP:
    filter_as(CS_PNG_UP, row, above, pixel_size, size, out);
    break;
  case CS_PNG_AVERAGE:
    filter_as(CS_PNG_AVERAGE, row, above, pixel_size, size, out);
    break;
  case CS_PNG_PAETH:
    filter_as(CS_PNG_PAETH, row, above, pixel_size, size, out);
    break;
  }
}

/* The sum of the sizes of the residues as signed bytes: the usual guess at what compresses best.
 * size: at most 255 blocks, or a word would overflow; what is beyond the last whole block is left
 * out. */
static inline uint64_t cost_as(cs_png_filter kind, const unsigned char *row,
                               const unsigned char *above, size_t pixel_size, size_t size) {
  words sums = {0};
  uint64_t sum = 0;
  for (size_t i = 0; i + BLOCK <= size; i += BLOCK) {
    bytes block = residue(kind, row + i, above + i, pixel_size), negated = -block;
    words least = (words)select((bytes)(block <= negated), block, negated);
    sums += (least & 255) + (least >> 8);
  }
  for (int word = 0; word < BLOCK / 2; word++)
    sum += sums[word];
  return sum;
}

static void add_costs(uint64_t costs[5], const unsigned char *row, const unsigned char *above,
                      size_t pixel_size, size_t size) {
  costs[CS_PNG_NONE] += cost_as(CS_PNG_NONE, row, above, pixel_size, size);
  costs[CS_PNG_SUB] += cost_as(CS_PNG_SUB, row, above, pixel_size, size);
  costs[CS_PNG_UP] += cost_as(CS_PNG_UP, row, above, pixel_size, size);
  costs[CS_PNG_AVERAGE] += cost_as(CS_PNG_AVERAGE, row, above, pixel_size, size);
  costs[CS_PNG_PAETH] += cost_as(CS_PNG_PAETH, row, above, pixel_size, size);
}

static cs_png_filter choose_for_bytes(size_t pixel_size, size_t size, const unsigned char *row,
                                      const unsigned char *above) {
  uint64_t costs[5] = {0};
  for (size_t at = 0; at < size; at += SCRATCH) {
    size_t part = size - at < SCRATCH ? size - at : SCRATCH;
    add_costs(costs, row + at, above + at, pixel_size, part);
  }
  int best = CS_PNG_NONE;
  for (int kind = CS_PNG_SUB; kind <= CS_PNG_PAETH; kind++)
    if (costs[kind] < costs[best])
      best = kind;
  return (cs_png_filter)best;
}

celspan_status cs_png_filter_bytes(cs_deflate *deflate, celspan_context *context, size_t pixel_size,
                                   size_t size, const unsigned char *row,
                                   const unsigned char *above) {
  unsigned char scratch[SCRATCH];
  cs_png_filter chosen = choose_for_bytes(pixel_size, size, row, above);
  unsigned char byte = (unsigned char)chosen;
  CS_TRY(cs_deflate_bytes(deflate, context, &byte, 1));
  for (size_t at = 0; at < size; at += SCRATCH) {
    size_t part = size - at < SCRATCH ? size - at : SCRATCH;
    filter_part(chosen, row + at, above + at, pixel_size, part, scratch);
    CS_TRY(cs_deflate_bytes(deflate, context, scratch, part));
  }
  return CELSPAN_OK;
}
