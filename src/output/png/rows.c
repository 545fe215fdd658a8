#include "output/png/rows.h"

#include <string.h>

#include "output/pixels.h"
#include "output/png/filter_bytes.h"

/* A row becomes bytes when gradients and arrays of at least LONG_SPAN pixels cover more than a
 * DENSE_SHARE-th of it. */
enum { CHUNK = 64, LONG_SPAN = 16, DENSE_SHARE = 8 };

void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width, bool is_opaque) {
  size_t coded_size = celspan_coding_pixel_size(&coding);
  *rows = (cs_png_rows){.coding = coding,
                        .width = width,
                        .coded_size = coded_size,
                        .pixel_size = is_opaque ? coded_size / 4 * 3 : coded_size};
  cs_png_filter_runs_begin(&rows->filter, width, rows->pixel_size);
  rows->stored = UINT64_MAX >> (64 - 8 * rows->pixel_size);
}

void cs_png_rows_restart(cs_png_rows *rows) { cs_png_filter_runs_restart(&rows->filter); }

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
  cs_png_filter_runs_end(&rows->filter, context);
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
  uint64_t common; /* as of cs_png_rows */
} tail;

/* Adds columns up to `end`. pixel: as coded. */
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
  unsigned char *bytes = cs_mem_array(context->memory, bytes_allocated(rows), 1);
  if (!bytes)
    return cs_fail_memory(context);
  row->bytes = bytes + rows->pixel_size;
  return CELSPAN_OK;
}

/* Coded pixels of 16 bits a channel to those of the file, in place. */
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

/* The most runs that the spans can become, and whether the row is to be bytes. */
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
    CS_TRY(cs_mem_reserve(context, (void **)&row->runs.runs, &row->runs.capacity, runs,
                          sizeof *row->runs.runs));
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
    return cs_png_filter_runs_put(&rows->filter, context, &row->runs, &above->runs, deflate);
  bool is_first = !above->is_bytes && above->runs.count == 0;
  cs_png_filter most = is_first && rows->is_strip ? CS_PNG_SUB : CS_PNG_PAETH;
  if (!above->is_bytes)
    CS_TRY(runs_to_bytes(rows, context, above));
  return cs_png_filter_bytes_put(deflate, context, most, rows->pixel_size,
                                 (size_t)rows->width * rows->pixel_size, row->bytes, above->bytes);
}
