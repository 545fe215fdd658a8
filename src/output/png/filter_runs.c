/* A row of runs is filtered without being laid out: what a filter leaves of it are runs again, and
 * what they cost is told before they are compressed.
 */
#include <string.h>

#include "output/png/filter.h"

/* Of a large picture, rows are much like the ones above: a filter is kept for a further row with
 * each such width, up to KEPT_MOST, and Paeth, which wins next to nothing there, is not tried. */
enum { KEPT_WIDTH = 4096, KEPT_MOST = 15 };

/* About the bits of a run, in eighths: literals of the residue by their size, and a match when it
 * goes on. */
enum { MORE_BITS = 80 };

void cs_png_costs_fill(cs_png_costs *costs) {
  for (int byte = 0; byte < 256; byte++) {
    unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
    unsigned octave = 31u - (unsigned)__builtin_clz(size);
    costs->literal[byte] =
        (uint8_t)(20 + 10 * octave + 10 * (size - (1u << octave)) / (1u << octave));
  }
}

/* ---------------------------------------------------------------- filters; pixel_size is known to
 * the compiler wherever it is used */

/* x - y in each of eight bytes. */
static inline uint64_t subtract_bytes(uint64_t x, uint64_t y) {
  const uint64_t high = 0x8080808080808080u;
  return ((x | high) - (y & ~high)) ^ ((x ^ ~y) & high);
}

static size_t filter_sub(const cs_png_row *row, cs_deflate_run *out) {
  cs_deflate_run *next = out;
  uint64_t left = 0;
  int32_t x = 0;
  for (const cs_png_run *run = row->runs; run < row->runs + row->run_count; run++) {
    *next++ = (cs_deflate_run){subtract_bytes(run->pixel, left), 1};
    *next = (cs_deflate_run){0, (uint32_t)(run->end - x - 1)};
    next += next->count > 0;
    left = run->pixel;
    x = run->end;
  }
  return (size_t)(next - out);
}

/* Pieces with the same difference are joined, so that an unchanged row is one run. */
static size_t filter_up(const cs_png_row *row, const cs_png_row *above, cs_deflate_run *out) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  cs_deflate_run *next = out, held = {0};
  int32_t x = 0;
  while (run < last) {
    uint64_t difference = subtract_bytes(run->pixel, upper->pixel);
    int32_t end = upper->end < run->end ? upper->end : run->end;
    *next = held;
    next += difference != held.pixel && held.count > 0;
    held.count = (difference == held.pixel ? held.count : 0) + (uint32_t)(end - x);
    held.pixel = difference;
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  *next++ = held;
  return (size_t)(next - out);
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
static inline size_t filter_paeth(const cs_png_row *row, const cs_png_row *above, size_t pixel_size,
                                  cs_deflate_run *out) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->run_count;
  cs_deflate_run *next = out;
  uint64_t left = 0, corner = 0;
  int32_t x = 0;
  while (run < last) {
    uint64_t guess = paeth_pixel(left, upper->pixel, corner, pixel_size);
    *next++ = (cs_deflate_run){subtract_bytes(run->pixel, guess), 1};
    left = run->pixel;
    corner = upper->pixel;
    int32_t end = upper->end < run->end ? upper->end : run->end;
    *next = (cs_deflate_run){0, (uint32_t)(end - x - 1)};
    next += next->count > 0;
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  return (size_t)(next - out);
}

static inline uint64_t cost(const cs_png_costs *costs, const cs_deflate_run *run, size_t count,
                            size_t pixel_size) {
  uint64_t bits = 0;
  bool in_zeros = false;
  for (const cs_deflate_run *end = run + count; run < end; run++) {
    if (run->pixel == 0) {
      bits += in_zeros || run->count == 1 ? 0 : MORE_BITS;
      in_zeros |= run->count > 1;
      continue;
    }
    for (size_t i = 0; i < pixel_size; i++)
      bits += costs->literal[run->pixel >> 8 * i & 255];
    bits += run->count > 1 ? MORE_BITS : 0;
    in_zeros = false;
  }
  return bits;
}

/* ---------------------------------------------------------------- the choice */

/* What a filter leaves of the row in hand. */
typedef struct residue {
  cs_png_filter filter;
  cs_deflate_run *runs;
  size_t count;
} residue;

static inline void filter_as(cs_png_filter kind, const cs_png_row *row, const cs_png_row *above,
                             size_t pixel_size, residue *out) {
  out->filter = kind;
  out->count = kind == CS_PNG_SUB  ? filter_sub(row, out->runs)
               : kind == CS_PNG_UP ? filter_up(row, above, out->runs)
                                   : filter_paeth(row, above, pixel_size, out->runs);
}

/* Of Up, Sub and Paeth; where they cost the same, the one that is made quicker. */
static inline residue filter_best(const cs_png_rows *rows, const cs_png_row *row,
                                  const cs_png_row *above, size_t pixel_size) {
  static const cs_png_filter tried[3] = {CS_PNG_UP, CS_PNG_SUB, CS_PNG_PAETH};
  int count = rows->width < KEPT_WIDTH ? 3 : 2;
  residue best = {.runs = rows->residues[0]}, other = {.runs = rows->residues[1]};
  uint64_t least = UINT64_MAX;
  for (int i = 0; i < count; i++) {
    filter_as(tried[i], row, above, pixel_size, &other);
    uint64_t bits = cost(&rows->costs, other.runs, other.count, pixel_size);
    if (bits < least) {
      residue spare = best;
      best = other;
      other = spare;
      least = bits;
    }
  }
  return best;
}

static bool is_same(const cs_png_row *row, const cs_png_row *above) {
  if (row->run_count != above->run_count)
    return false;
  for (size_t i = 0; i < row->run_count; i++)
    if (row->runs[i].end != above->runs[i].end || row->runs[i].pixel != above->runs[i].pixel)
      return false;
  return true;
}

static inline residue filter_of_size(cs_png_rows *rows, const cs_png_row *row,
                                     const cs_png_row *above, size_t pixel_size) {
  residue left = {.runs = rows->residues[0]};
  if (above->run_count == 0) {
    filter_as(CS_PNG_SUB, row, above, pixel_size, &left);
  } else if (is_same(row, above)) {
    filter_as(CS_PNG_UP, row, above, pixel_size, &left);
  } else if (rows->kept > 0) {
    rows->kept--;
    filter_as((cs_png_filter)rows->filter, row, above, pixel_size, &left);
  } else {
    int most = rows->width / KEPT_WIDTH;
    left = filter_best(rows, row, above, pixel_size);
    rows->filter = (int)left.filter;
    rows->kept = most < KEPT_MOST ? most : KEPT_MOST;
  }
  return left;
}

static residue filter_row(cs_png_rows *rows, const cs_png_row *row, const cs_png_row *above) {
  switch (rows->pixel_size) {
  case 3:
    return filter_of_size(rows, row, above, 3);
  case 4:
    return filter_of_size(rows, row, above, 4);
  case 6:
    return filter_of_size(rows, row, above, 6);
  default:
    return filter_of_size(rows, row, above, 8);
  }
}

celspan_status cs_png_filter_runs(cs_png_rows *rows, celspan_context *context,
                                  const cs_png_row *row, const cs_png_row *above,
                                  cs_deflate *deflate) {
  size_t most = 2 * (row->run_count + above->run_count) + 1;
  for (int i = 0; i < 2; i++)
    CS_TRY(cs_mem_reserve(context, (void **)&rows->residues[i], &rows->residue_capacities[i], most,
                          sizeof *rows->residues[i]));
  residue left = filter_row(rows, row, above);
  cs_deflate_byte(deflate, (unsigned char)left.filter);
  return cs_deflate_runs(deflate, context, left.runs, left.count);
}
