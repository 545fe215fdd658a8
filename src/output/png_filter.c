#include "output/png_filter.h"

#include <string.h>

typedef enum filter { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH } filter;

/* ---------------------------------------------------------------- runs */

/* x - y in each of eight bytes. */
static uint64_t subtract_bytes(uint64_t x, uint64_t y) {
  const uint64_t high = 0x8080808080808080u;
  return ((x | high) - (y & ~high)) ^ ((x ^ ~y) & high);
}

/* About the bits a run costs, in eighths: a literal of a difference by its size, one of a colour
 * always the same; and a match when it goes on. */
enum { COLOUR_BITS = 56, MORE_BITS = 80 };

void cs_png_costs_fill(cs_png_costs *costs) {
  for (int byte = 0; byte < 256; byte++) {
    unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
    unsigned octave = 31u - (unsigned)__builtin_clz(size);
    costs->literal[byte] =
        (uint8_t)(20 + 10 * octave + 10 * (size - (1u << octave)) / (1u << octave));
  }
}

/* pixel_size: known to the compiler wherever this is used. */
static inline unsigned pixel_cost(const cs_png_costs *costs, uint64_t pixel, size_t pixel_size) {
  unsigned cost = 0;
  for (size_t i = 0; i < pixel_size; i++)
    cost += costs->literal[pixel >> 8 * i & 255];
  return cost;
}

/* As None and as Sub, whose runs are the row's own. */
static inline void cost_within(const cs_png_costs *costs, const cs_png_row *row, size_t pixel_size,
                               uint64_t *none, uint64_t *sub) {
  uint64_t cost = 0, left = 0, more = 0;
  int32_t x = 0;
  for (const cs_png_run *run = row->runs; run < row->runs + row->run_count; run++) {
    cost += pixel_cost(costs, subtract_bytes(run->pixel, left), pixel_size);
    more += run->end - x > 1;
    left = run->pixel;
    x = run->end;
  }
  *none = row->run_count * COLOUR_BITS * pixel_size + more * MORE_BITS;
  *sub = cost + more * MORE_BITS;
}

static inline uint64_t cost_up(const cs_png_costs *costs, const cs_png_row *row,
                               const cs_png_row *above, size_t pixel_size) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  uint64_t cost = 0, held = 1;
  int32_t x = 0;
  while (run < last) {
    uint64_t difference = subtract_bytes(run->pixel, upper->pixel);
    int32_t end = upper->end < run->end ? upper->end : run->end;
    if (difference != held) {
      cost += difference ? pixel_cost(costs, difference, pixel_size) : 0;
      cost += end - x > 1 ? MORE_BITS : 0;
      held = difference;
    }
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  return cost;
}

/* The one of three neighbours nearest to left + above - corner, byte by byte. */
static inline uint64_t paeth_pixel(uint64_t left, uint64_t above, uint64_t corner, size_t size) {
  uint64_t nearest = 0;
  if (above == corner)
    return left;
  if (left == corner)
    return above;
  for (size_t i = 0; i < 8 * size; i += 8) {
    int a = left >> i & 255, b = above >> i & 255, c = corner >> i & 255;
    int from_a = b > c ? b - c : c - b, from_b = a > c ? a - c : c - a;
    int sum = a + b - 2 * c, from_c = sum < 0 ? -sum : sum;
    int chosen = from_a <= from_b && from_a <= from_c ? a : from_b <= from_c ? b : c;
    nearest |= (uint64_t)chosen << i;
  }
  return nearest;
}

/* Where neither row changes, the pixel to the left is the guess and it is right: only the first
 * pixel of a piece is left over. */
static inline uint64_t cost_paeth(const cs_png_costs *costs, const cs_png_row *row,
                                  const cs_png_row *above, size_t pixel_size) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  uint64_t cost = 0, left = 0, corner = 0;
  int32_t x = 0;
  bool in_zeros = false;
  while (run < last) {
    uint64_t guess = paeth_pixel(left, upper->pixel, corner, pixel_size);
    if (guess != run->pixel) {
      cost += pixel_cost(costs, subtract_bytes(run->pixel, guess), pixel_size);
      in_zeros = false;
    }
    left = run->pixel;
    corner = upper->pixel;
    int32_t end = upper->end < run->end ? upper->end : run->end;
    cost += !in_zeros && end - x > 1 ? MORE_BITS : 0;
    in_zeros = in_zeros || end - x > 1;
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  return cost;
}

static inline filter choose_of_size(const cs_png_costs *costs, const cs_png_row *row,
                                    const cs_png_row *above, size_t pixel_size) {
  uint64_t none, sub;
  cost_within(costs, row, pixel_size, &none, &sub);
  filter best = none <= sub ? FILTER_NONE : FILTER_SUB;
  uint64_t least = none <= sub ? none : sub;
  if (above->run_count == 0)
    return best;
  uint64_t up = cost_up(costs, row, above, pixel_size);
  uint64_t paeth = cost_paeth(costs, row, above, pixel_size);
  if (up <= least) {
    best = FILTER_UP;
    least = up;
  }
  return paeth < least ? FILTER_PAETH : best;
}

static filter choose_for_runs(const cs_png_costs *costs, const cs_png_row *row,
                              const cs_png_row *above, size_t pixel_size) {
  switch (pixel_size) {
  case 3:
    return choose_of_size(costs, row, above, 3);
  case 4:
    return choose_of_size(costs, row, above, 4);
  case 6:
    return choose_of_size(costs, row, above, 6);
  default:
    return choose_of_size(costs, row, above, 8);
  }
}

static celspan_status put_none(cs_deflate *deflate, celspan_context *context,
                               const cs_png_row *row) {
  int32_t x = 0;
  for (const cs_png_run *run = row->runs; run < row->runs + row->run_count; run++) {
    CS_TRY(cs_deflate_run(deflate, context, run->pixel, (size_t)(run->end - x)));
    x = run->end;
  }
  return CELSPAN_OK;
}

static celspan_status put_sub(cs_deflate *deflate, celspan_context *context,
                              const cs_png_row *row) {
  uint64_t left = 0;
  int32_t x = 0;
  for (const cs_png_run *run = row->runs; run < row->runs + row->run_count; run++) {
    CS_TRY(cs_deflate_run(deflate, context, subtract_bytes(run->pixel, left), 1));
    if (run->end - x > 1)
      CS_TRY(cs_deflate_run(deflate, context, 0, (size_t)(run->end - x - 1)));
    left = run->pixel;
    x = run->end;
  }
  return CELSPAN_OK;
}

/* Pieces with the same difference are joined, so that an unchanged row is one run. */
static celspan_status put_up(cs_deflate *deflate, celspan_context *context, const cs_png_row *row,
                             const cs_png_row *above) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  uint64_t held = subtract_bytes(run->pixel, upper->pixel);
  int32_t x = 0, held_from = 0;
  while (run < last) {
    uint64_t difference = subtract_bytes(run->pixel, upper->pixel);
    if (difference != held) {
      CS_TRY(cs_deflate_run(deflate, context, held, (size_t)(x - held_from)));
      held = difference;
      held_from = x;
    }
    x = upper->end < run->end ? upper->end : run->end;
    upper += upper->end == x;
    run += run->end == x;
  }
  return cs_deflate_run(deflate, context, held, (size_t)(x - held_from));
}

static celspan_status put_paeth(cs_deflate *deflate, celspan_context *context,
                                const cs_png_row *row, const cs_png_row *above, size_t pixel_size) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  uint64_t left = 0, corner = 0;
  int32_t x = 0;
  while (run < last) {
    uint64_t guess = paeth_pixel(left, upper->pixel, corner, pixel_size);
    CS_TRY(cs_deflate_run(deflate, context, subtract_bytes(run->pixel, guess), 1));
    left = run->pixel;
    corner = upper->pixel;
    int32_t end = upper->end < run->end ? upper->end : run->end;
    if (end - x > 1)
      CS_TRY(cs_deflate_run(deflate, context, 0, (size_t)(end - x - 1)));
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  return CELSPAN_OK;
}

celspan_status cs_png_filter_runs(cs_deflate *deflate, celspan_context *context,
                                  const cs_png_costs *costs, size_t pixel_size,
                                  const cs_png_row *row, const cs_png_row *above) {
  filter chosen = choose_for_runs(costs, row, above, pixel_size);
  cs_deflate_byte(deflate, (unsigned char)chosen);
  switch (chosen) {
  case FILTER_NONE:
    return put_none(deflate, context, row);
  case FILTER_SUB:
    return put_sub(deflate, context, row);
  case FILTER_PAETH:
    return put_paeth(deflate, context, row, above, pixel_size);
  default:
    return put_up(deflate, context, row, above);
  }
}

/* ---------------------------------------------------------------- bytes */

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
static inline bytes residue(filter kind, const unsigned char *row, const unsigned char *above,
                            size_t pixel_size) {
  bytes x = load_block(row), a = load_block(row - pixel_size), b = load_block(above);
  switch (kind) {
  case FILTER_NONE:
    return x;
  case FILTER_SUB:
    return x - a;
  case FILTER_UP:
    return x - b;
  case FILTER_AVERAGE:
    return x - ((a & b) + ((a ^ b) >> 1));
  case FILTER_PAETH:
    return x - paeth(a, b, load_block(above - pixel_size));
  }
  return x;
}

static inline void filter_as(filter kind, const unsigned char *row, const unsigned char *above,
                             size_t pixel_size, size_t size, unsigned char *out) {
  for (size_t i = 0; i < size; i += BLOCK) {
    bytes block = residue(kind, row + i, above + i, pixel_size);
    memcpy(out + i, &block, sizeof block);
  }
}

/* Size is rounded up to whole blocks. */
static void filter_part(filter kind, const unsigned char *row, const unsigned char *above,
                        size_t pixel_size, size_t size, unsigned char *out) {
  switch (kind) {
  case FILTER_NONE:
    filter_as(FILTER_NONE, row, above, pixel_size, size, out);
    break;
  case FILTER_SUB:
    filter_as(FILTER_SUB, row, above, pixel_size, size, out);
    break;
  case FILTER_UP:
    filter_as(FILTER_UP, row, above, pixel_size, size, out);
    break;
  case FILTER_AVERAGE:
    filter_as(FILTER_AVERAGE, row, above, pixel_size, size, out);
    break;
  case FILTER_PAETH:
    filter_as(FILTER_PAETH, row, above, pixel_size, size, out);
    break;
  }
}

/* The sum of the sizes of the residues as signed bytes: the usual guess at what compresses best.
 * size: at most 255 blocks, or a word would overflow; what is beyond the last whole block is left
 * out. */
static inline uint64_t cost_as(filter kind, const unsigned char *row, const unsigned char *above,
                               size_t pixel_size, size_t size) {
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
  costs[FILTER_NONE] += cost_as(FILTER_NONE, row, above, pixel_size, size);
  costs[FILTER_SUB] += cost_as(FILTER_SUB, row, above, pixel_size, size);
  costs[FILTER_UP] += cost_as(FILTER_UP, row, above, pixel_size, size);
  costs[FILTER_AVERAGE] += cost_as(FILTER_AVERAGE, row, above, pixel_size, size);
  costs[FILTER_PAETH] += cost_as(FILTER_PAETH, row, above, pixel_size, size);
}

static filter choose_for_bytes(size_t pixel_size, size_t size, const unsigned char *row,
                               const unsigned char *above) {
  uint64_t costs[5] = {0};
  for (size_t at = 0; at < size; at += SCRATCH) {
    size_t part = size - at < SCRATCH ? size - at : SCRATCH;
    add_costs(costs, row + at, above + at, pixel_size, part);
  }
  int best = FILTER_NONE;
  for (int kind = FILTER_SUB; kind <= FILTER_PAETH; kind++)
    if (costs[kind] < costs[best])
      best = kind;
  return (filter)best;
}

celspan_status cs_png_filter_bytes(cs_deflate *deflate, celspan_context *context, size_t pixel_size,
                                   size_t size, const unsigned char *row,
                                   const unsigned char *above) {
  unsigned char scratch[SCRATCH];
  filter chosen = choose_for_bytes(pixel_size, size, row, above);
  unsigned char byte = (unsigned char)chosen;
  CS_TRY(cs_deflate_bytes(deflate, context, &byte, 1));
  for (size_t at = 0; at < size; at += SCRATCH) {
    size_t part = size - at < SCRATCH ? size - at : SCRATCH;
    filter_part(chosen, row + at, above + at, pixel_size, part, scratch);
    CS_TRY(cs_deflate_bytes(deflate, context, scratch, part));
  }
  return CELSPAN_OK;
}
