#include "output/png/filter_runs.h"

#include <string.h>

/* In a large picture successive rows are alike. So a choice is kept for one more row for each
 * KEPT_WIDTH of the width, up to KEPT_MOST, and Paeth, which gains hardly anything there, is not
 * tried. */
enum { KEPT_WIDTH = 4096, KEPT_MOST = 15 };

/* The estimated cost of a run, in eighths of a bit, is that of its first pixel as literals, by the
 * size of the differences, and MATCH_COST when there are more pixels. */
enum { MATCH_COST = 80 };

static void fill_costs(uint8_t costs[256]) {
  for (int byte = 0; byte < 256; byte++) {
    unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
    unsigned octave = 31u - (unsigned)__builtin_clz(size);
    costs[byte] = (uint8_t)(20 + 10 * octave + 10 * (size - (1u << octave)) / (1u << octave));
  }
}

void cs_png_filter_runs_begin(cs_png_filter_runs *filter, int32_t width, size_t pixel_size) {
  *filter = (cs_png_filter_runs){.width = width, .pixel_size = pixel_size};
  fill_costs(filter->literal_costs);
}

void cs_png_filter_runs_restart(cs_png_filter_runs *filter) { filter->kept = 0; }

void cs_png_filter_runs_end(cs_png_filter_runs *filter, celspan_context *context) {
  for (int i = 0; i < 2; i++)
    cs_mem_free(context->memory, filter->differences[i],
                filter->capacities[i] * sizeof *filter->differences[i]);
}

/* ---------------------------------------------------------------- filters; pixel_size is a
 * constant for the compiler wherever it is used */

/* x - y in each of eight bytes. */
static inline uint64_t subtract_bytes(uint64_t x, uint64_t y) {
  const uint64_t high = 0x8080808080808080u;
  return ((x | high) - (y & ~high)) ^ ((x ^ ~y) & high);
}

static size_t filter_sub(const cs_png_runs *row, cs_deflate_run *out) {
  cs_deflate_run *next = out;
  uint64_t left = 0;
  int32_t x = 0;
  for (const cs_png_run *run = row->runs; run < row->runs + row->count; run++) {
    *next++ = (cs_deflate_run){subtract_bytes(run->pixel, left), 1};
    *next = (cs_deflate_run){0, (uint32_t)(run->end - x - 1)};
    next += next->count > 0;
    left = run->pixel;
    x = run->end;
  }
  return (size_t)(next - out);
}

/* Neighbours with the same difference are joined, so that an unchanged row is one run. */
static size_t filter_up(const cs_png_runs *row, const cs_png_runs *above, cs_deflate_run *out) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->count;
  cs_deflate_run *next = out, last_run = {0};
  int32_t x = 0;
  while (run < last) {
    uint64_t difference = subtract_bytes(run->pixel, upper->pixel);
    int32_t end = upper->end < run->end ? upper->end : run->end;
    *next = last_run;
    next += difference != last_run.pixel && last_run.count > 0;
    last_run.count = (difference == last_run.pixel ? last_run.count : 0) + (uint32_t)(end - x);
    last_run.pixel = difference;
    x = end;
    upper += upper->end == x;
    run += run->end == x;
  }
  *next++ = last_run;
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

/* Where neither row changes, Paeth predicts the pixel to the left, rightly: so between two changes
 * only the first pixel has a difference. */
static inline size_t filter_paeth(const cs_png_runs *row, const cs_png_runs *above,
                                  size_t pixel_size, cs_deflate_run *out) {
  const cs_png_run *run = row->runs, *upper = above->runs, *last = row->runs + row->count;
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

static inline uint64_t cost(const uint8_t literal_costs[256], const cs_deflate_run *run,
                            size_t count, size_t pixel_size) {
  uint64_t bits = 0;
  bool in_zeros = false;
  for (const cs_deflate_run *end = run + count; run < end; run++) {
    if (run->pixel == 0) {
      bits += in_zeros || run->count == 1 ? 0 : MATCH_COST;
      in_zeros |= run->count > 1;
      continue;
    }
    for (size_t i = 0; i < pixel_size; i++)
      bits += literal_costs[run->pixel >> 8 * i & 255];
    bits += run->count > 1 ? MATCH_COST : 0;
    in_zeros = false;
  }
  return bits;
}

/* ---------------------------------------------------------------- the choice */

/* A row under a filter. */
typedef struct filtered {
  cs_png_filter filter;
  cs_deflate_run *runs;
  size_t count;
} filtered;

static inline void filter_as(cs_png_filter kind, const cs_png_runs *row, const cs_png_runs *above,
                             size_t pixel_size, filtered *out) {
  out->filter = kind;
  out->count = kind == CS_PNG_SUB  ? filter_sub(row, out->runs)
               : kind == CS_PNG_UP ? filter_up(row, above, out->runs)
                                   : filter_paeth(row, above, pixel_size, out->runs);
}

/* The best of Up, Sub and Paeth; of equal ones the first, which is the faster. */
static inline filtered filter_best(const cs_png_filter_runs *filter, const cs_png_runs *row,
                                   const cs_png_runs *above, size_t pixel_size) {
  static const cs_png_filter tried[3] = {CS_PNG_UP, CS_PNG_SUB, CS_PNG_PAETH};
  int count = filter->width < KEPT_WIDTH ? 3 : 2;
  filtered best = {.runs = filter->differences[0]}, other = {.runs = filter->differences[1]};
  uint64_t least = UINT64_MAX;
  for (int i = 0; i < count; i++) {
    filter_as(tried[i], row, above, pixel_size, &other);
    uint64_t bits = cost(filter->literal_costs, other.runs, other.count, pixel_size);
    if (bits < least) {
      filtered spare = best;
      best = other;
      other = spare;
      least = bits;
    }
  }
  return best;
}

static bool is_same(const cs_png_runs *row, const cs_png_runs *above) {
  if (row->count != above->count)
    return false;
  for (size_t i = 0; i < row->count; i++)
    if (row->runs[i].end != above->runs[i].end || row->runs[i].pixel != above->runs[i].pixel)
      return false;
  return true;
}

static inline filtered filter_of_size(cs_png_filter_runs *filter, const cs_png_runs *row,
                                      const cs_png_runs *above, size_t pixel_size) {
  filtered made = {.runs = filter->differences[0]};
  if (above->count == 0) {
    filter_as(CS_PNG_SUB, row, above, pixel_size, &made);
  } else if (is_same(row, above)) {
    filter_as(CS_PNG_UP, row, above, pixel_size, &made);
  } else if (filter->kept > 0) {
    filter->kept--;
    filter_as(filter->last, row, above, pixel_size, &made);
  } else {
    int most = filter->width / KEPT_WIDTH;
    made = filter_best(filter, row, above, pixel_size);
    filter->last = made.filter;
    filter->kept = most < KEPT_MOST ? most : KEPT_MOST;
  }
  return made;
}

static filtered filter_row(cs_png_filter_runs *filter, const cs_png_runs *row,
                           const cs_png_runs *above) {
  switch (filter->pixel_size) {
  case 3:
    return filter_of_size(filter, row, above, 3);
  case 4:
    return filter_of_size(filter, row, above, 4);
  case 6:
    return filter_of_size(filter, row, above, 6);
  default:
    return filter_of_size(filter, row, above, 8);
  }
}

celspan_status cs_png_filter_runs_put(cs_png_filter_runs *filter, celspan_context *context,
                                      const cs_png_runs *row, const cs_png_runs *above,
                                      cs_deflate *deflate) {
  size_t most = 2 * (row->count + above->count) + 1;
  for (int i = 0; i < 2; i++)
    CS_TRY(cs_mem_reserve(context, (void **)&filter->differences[i], &filter->capacities[i], most,
                          sizeof *filter->differences[i]));
  filtered best = filter_row(filter, row, above);
  cs_deflate_byte(deflate, (unsigned char)best.filter);
  return cs_deflate_runs(deflate, context, best.runs, best.count);
}
