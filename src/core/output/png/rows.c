#include "output/png/rows.h"

#include <string.h>

/* ---------------------------------------------------------------- rows of runs */

/* In a large picture successive rows are similar. Therefore a choice is kept for one more row for
 * each KEPT_WIDTH of the width, up to KEPT_MOST rows; and Paeth, which saves hardly anything there,
 * is not tried. */
enum { KEPT_WIDTH = 4096, KEPT_MOST = 15 };

/* The estimated cost of a run, in eighths of a bit: the cost of its first pixel as literals, by the
 * size of the differences, plus MATCH_COST if there are more pixels. */
enum { MATCH_COST = 80 };

static void fill_costs(uint8_t costs[256]) {
  for (int byte = 0; byte < 256; byte++) {
    unsigned size = (unsigned)(byte < 128 ? byte : 256 - byte) + 1;
    unsigned octave = 31u - (unsigned)__builtin_clz(size);
    costs[byte] = (uint8_t)(20 + 10 * octave + 10 * (size - (1u << octave)) / (1u << octave));
  }
}

static void begin_filter(cs_png_filter_runs *filter, int32_t width, size_t pixel_size) {
  *filter = (cs_png_filter_runs){.width = width, .pixel_size = pixel_size};
  fill_costs(filter->literal_costs);
}

/* Forgets the filters that were chosen for earlier rows. */
static void restart_filter(cs_png_filter_runs *filter) { filter->kept = 0; }

static void end_filter(cs_png_filter_runs *filter, celspan_context *context) {
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

/* Neighbours with the same difference are joined, so that a row without changes is one run. */
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

/* The nearest of three neighbours to left + above - corner, byte by byte. */
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

/* Where neither row changes, Paeth correctly predicts the pixel to the left. So only the first
 * pixel after a change has a difference. */
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

/* The best of Up, Sub and Paeth; of equal ones the first, because it is faster. */
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

/* Puts a row: the filter's number and the differences. If the row above is not known as runs, only
 * Sub is considered. */
static CELSPAN_CHECKED celspan_status put_filtered_runs(cs_png_filter_runs *filter,
                                                        celspan_context *context,
                                                        const cs_png_runs *row,
                                                        const cs_png_runs *above,
                                                        cs_deflate *deflate) {
  size_t most = 2 * (row->count + above->count) + 1;
  for (int i = 0; i < 2; i++)
    CS_TRY(CS_RESERVE(context, filter->differences[i], filter->capacities[i], most));
  filtered best = filter_row(filter, row, above);
  cs_deflate_byte(deflate, (unsigned char)best.filter);
  return cs_deflate_runs(deflate, context, best.runs, best.count);
}

/* ---------------------------------------------------------------- rows of bytes */

/* The filters of PNG over rows of bytes: the filter whose differences cost least is used.
 *
 * INVARIANT: rows have zeros around them, as output/png/bytes.h draws.
 */

static cs_png_filter choose(cs_isa isa, cs_png_filter most, size_t pixel_size, size_t size,
                            const unsigned char *row, const unsigned char *above) {
  uint64_t costs[CS_PNG_FILTERS] = {0};
  for (size_t at = 0; at < size; at += CS_PNG_COST_MOST) {
    size_t count = size - at < CS_PNG_COST_MOST ? size - at : CS_PNG_COST_MOST;
    CS_WIDE_CHOOSE(isa, cs_png_bytes_add_costs)(row + at, above + at, pixel_size, count, costs);
  }
  int best = CS_PNG_NONE;
  for (int kind = CS_PNG_SUB; kind <= (int)most; kind++)
    if (costs[kind] < costs[best])
      best = kind;
  return (cs_png_filter)best;
}

/* most: the last filter that is tried. None and Sub come first, because they do not use the row
 * above. size: bytes of the row. */
static CELSPAN_CHECKED celspan_status put_filtered_bytes(cs_deflate *deflate,
                                                         celspan_context *context,
                                                         cs_png_filter most, size_t pixel_size,
                                                         size_t size, const unsigned char *row,
                                                         const unsigned char *above) {
  cs_isa isa = cs_isa_best();
  cs_png_filter chosen = choose(isa, most, pixel_size, size, row, above);
  unsigned char *out = cs_deflate_space(deflate, context);
  *out = (unsigned char)chosen;
  CS_TRY(cs_deflate_commit(deflate, out, 1));
  for (size_t at = 0; at < size; at += CS_DEFLATE_SPACE) {
    size_t count = size - at < CS_DEFLATE_SPACE ? size - at : CS_DEFLATE_SPACE;
    out = cs_deflate_space(deflate, context);
    CS_WIDE_CHOOSE(isa, cs_png_bytes_filter)(chosen, row + at, above + at, pixel_size, count, out);
    CS_TRY(cs_deflate_commit(deflate, out, count));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

/* A row is stored as bytes if gradients and arrays of at least LONG_SPAN pixels cover more than
 * 1/DENSE_SHARE of it. */
enum { CHUNK = 64, LONG_SPAN = 16, DENSE_SHARE = 8 };

void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width, bool is_opaque) {
  size_t coded_size = cs_pixels_size(&coding);
  *rows = (cs_png_rows){.coding = coding,
                        .width = width,
                        .coded_size = coded_size,
                        .pixel_size = is_opaque ? coded_size / 4 * 3 : coded_size};
  begin_filter(&rows->filter, width, rows->pixel_size);
  rows->stored = UINT64_MAX >> (64 - 8 * rows->pixel_size);
}

void cs_png_rows_restart(cs_png_rows *rows) { restart_filter(&rows->filter); }

static size_t bytes_allocated(const cs_png_rows *rows) {
  return rows->pixel_size + rows->coded_size * (size_t)rows->width + CS_PNG_BATCH;
}

void cs_png_rows_end(cs_png_rows *rows, celspan_context *context) {
  for (int i = 0; i < 2; i++) {
    cs_png_row *row = &rows->rows[i];
    cs_mem_free(context->memory, row->runs.runs, row->runs.capacity * sizeof *row->runs.runs);
    if (row->bytes)
      cs_mem_free(context->memory, row->bytes - rows->pixel_size, bytes_allocated(rows));
  }
  end_filter(&rows->filter, context);
}

/* ---------------------------------------------------------------- spans to runs or bytes */

/* 16-bit samples are big endian in the file. */
static uint64_t swap_samples(uint64_t pixel) {
  return (pixel & 0x00ff00ff00ff00ffu) << 8 | (pixel >> 8 & 0x00ff00ff00ff00ffu);
}

/* The end of a row of runs, to which pixels are added. */
typedef struct tail {
  cs_png_run *next;
  const cs_png_run *first;
  uint64_t last;   /* the pixel of the last run */
  uint64_t common; /* as in cs_png_rows */
} tail;

/* Adds columns up to `end`. pixel: in its coded form. */
static inline void add_pixel(const cs_png_rows *rows, tail *t, int32_t end, uint64_t pixel) {
  pixel = rows->coded_size == 4 ? pixel : swap_samples(pixel);
  t->common &= pixel;
  pixel &= rows->stored;
  t->next -= t->next > t->first && t->last == pixel;
  t->last = pixel;
  *t->next++ = (cs_png_run){end, pixel};
}

static uint64_t load_pixel(const cs_png_rows *rows, const unsigned char *coded) {
  uint64_t eight;
  uint32_t four;
  if (rows->coded_size == 8)
    return memcpy(&eight, coded, sizeof eight), eight;
  return memcpy(&four, coded, sizeof four), four;
}

static void varying_to_runs(const cs_png_rows *rows, const celspan_span *span, tail *t) {
  unsigned char coded[8 * CHUNK];
  for (int32_t x = span->x0; x < span->x1; x += CHUNK) {
    int32_t count = span->x1 - x < CHUNK ? span->x1 - x : CHUNK;
    celspan_span cropped = cs_pixels_crop(span, x, count);
    cs_pixels_row(&rows->coding, &cropped, 1, coded);
    for (int32_t i = 0; i < count; i++)
      add_pixel(rows, t, x + i + 1, load_pixel(rows, coded + (size_t)i * rows->coded_size));
  }
}

/* At most CS_SINGLE_COLOURS_MOST spans. */
static void group_to_runs(cs_png_rows *rows, const celspan_span *spans, size_t count,
                          cs_png_runs *row) {
  tail t = {.next = row->runs + row->count, .first = row->runs, .common = rows->common};
  t.last = row->count > 0 ? t.next[-1].pixel : 0;
  cs_single_colours_code(&rows->colours, &rows->coding, spans, count);
  for (size_t i = 0; i < count; i++)
    if (spans[i].kind == CELSPAN_SPAN_SINGLE)
      add_pixel(rows, &t, spans[i].x1,
                cs_single_colours_pixel(&rows->colours, rows->coded_size, i));
    else
      varying_to_runs(rows, &spans[i], &t);
  row->count = (size_t)(t.next - t.first);
  rows->common = t.common;
}

static void spans_to_runs(cs_png_rows *rows, const celspan_span *spans, size_t span_count,
                          cs_png_runs *row) {
  for (size_t left = span_count, count; left > 0; left -= count, spans += count) {
    count = left < CS_SINGLE_COLOURS_MOST ? left : CS_SINGLE_COLOURS_MOST;
    group_to_runs(rows, spans, count, row);
  }
}

static celspan_status reserve_bytes(const cs_png_rows *rows, celspan_context *context,
                                    cs_png_row *row) {
  if (row->bytes)
    return CELSPAN_OK;
  unsigned char *bytes;
  CS_TRY(CS_MAKE(context, bytes, bytes_allocated(rows)));
  row->bytes = bytes + rows->pixel_size;
  return CELSPAN_OK;
}

/* Converts coded pixels of 16 bits per channel to the byte order of the file, in place. */
static inline void pack_samples(cs_png_rows *rows, unsigned char *bytes, size_t pixel_size) {
  unsigned char *to = bytes;
  for (int32_t x = 0; x < rows->width; x++, to += pixel_size) {
    uint64_t pixel = swap_samples(load_pixel(rows, bytes + 8 * (size_t)x));
    rows->common &= pixel;
    memcpy(to, &pixel, pixel_size);
  }
}

static void pack_bytes(cs_png_rows *rows, unsigned char *bytes) {
  if (rows->pixel_size == 3)
    rows->common &=
        CS_WIDE_CHOOSE(cs_isa_best(), cs_png_bytes_drop_alpha)(bytes, (size_t)rows->width);
  else if (rows->pixel_size == 6)
    pack_samples(rows, bytes, 6);
  else if (rows->pixel_size == 8)
    pack_samples(rows, bytes, 8);
  memset(bytes + (size_t)rows->width * rows->pixel_size, 0, CS_PNG_BATCH);
}

static celspan_status spans_to_bytes(cs_png_rows *rows, celspan_context *context,
                                     const celspan_span *spans, size_t span_count,
                                     cs_png_row *row) {
  CS_TRY(reserve_bytes(rows, context, row));
  cs_pixels_row(&rows->coding, spans, span_count, row->bytes);
  pack_bytes(rows, row->bytes);
  return CELSPAN_OK;
}

static celspan_status runs_to_bytes(const cs_png_rows *rows, celspan_context *context,
                                    cs_png_row *row) {
  CS_TRY(reserve_bytes(rows, context, row));
  unsigned char *at = row->bytes;
  int32_t x = 0;
  if (row->runs.count == 0)
    memset(row->bytes, 0, (size_t)rows->width * rows->pixel_size);
  for (size_t i = 0; i < row->runs.count; i++)
    for (const cs_png_run *run = &row->runs.runs[i]; x < run->end; x++, at += rows->pixel_size)
      memcpy(at, &run->pixel, rows->pixel_size);
  return CELSPAN_OK;
}

/* The most runs that the spans can become, and whether the row must become bytes. */
static size_t measure(const celspan_span *spans, size_t span_count, int32_t width, bool *is_dense) {
  size_t runs = span_count, dense = 0;
  for (const celspan_span *span = spans; span < spans + span_count; span++) {
    if (span->kind == CELSPAN_SPAN_SINGLE)
      continue;
    size_t length = (size_t)(span->x1 - span->x0);
    runs += length - 1;
    dense += length >= LONG_SPAN ? length : 0;
  }
  *is_dense = dense * DENSE_SHARE > (size_t)width;
  return runs;
}

static celspan_status check_opaque(const cs_png_rows *rows, celspan_context *context) {
  uint64_t coded = UINT64_MAX >> (64 - 8 * rows->coded_size), alpha = coded & ~rows->stored;
  if ((rows->common & alpha) == alpha)
    return CELSPAN_OK;
  return cs_fail(
      context, CELSPAN_BAD_ARGUMENT,
      "PNG: a row has pixels that are not opaque, in a picture that was begun as opaque");
}

static celspan_status code_row(cs_png_rows *rows, celspan_context *context,
                               const celspan_span *spans, size_t span_count, cs_png_row *row) {
  size_t runs = measure(spans, span_count, rows->width, &row->is_bytes);
  row->runs.count = 0;
  rows->common = UINT64_MAX;
  if (row->is_bytes) {
    CS_TRY(spans_to_bytes(rows, context, spans, span_count, row));
  } else {
    CS_TRY(CS_RESERVE(context, row->runs.runs, row->runs.capacity, runs));
    spans_to_runs(rows, spans, span_count, &row->runs);
  }
  return check_opaque(rows, context);
}

celspan_status cs_png_rows_set_above(cs_png_rows *rows, celspan_context *context,
                                     const celspan_span *spans, size_t span_count) {
  CS_TRY(code_row(rows, context, spans, span_count, &rows->rows[rows->current]));
  rows->current = !rows->current;
  return CELSPAN_OK;
}

celspan_status cs_png_rows_put(cs_png_rows *rows, celspan_context *context,
                               const celspan_span *spans, size_t span_count, cs_deflate *deflate) {
  CS_TRY(cs_png_rows_set_above(rows, context, spans, span_count));
  cs_png_row *row = &rows->rows[!rows->current], *above = &rows->rows[rows->current];
  if (!row->is_bytes)
    return put_filtered_runs(&rows->filter, context, &row->runs, &above->runs, deflate);
  bool is_first = !above->is_bytes && above->runs.count == 0;
  cs_png_filter most = is_first && rows->is_strip ? CS_PNG_SUB : CS_PNG_PAETH;
  if (!above->is_bytes)
    CS_TRY(runs_to_bytes(rows, context, above));
  return put_filtered_bytes(deflate, context, most, rows->pixel_size,
                            (size_t)rows->width * rows->pixel_size, row->bytes, above->bytes);
}
