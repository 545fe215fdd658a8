#include "output/sinks/ycc_sink.h"

#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"
#include "output/sinks/ycbcr.h"

enum { SHARE_ROWS = 32 }; /* an even number: two rows give one row of 4:2:0 */

static size_t halves(int32_t count) { return ((size_t)count + 1) / 2; }

static size_t luma_size(int32_t width, int32_t height) { return (size_t)width * (size_t)height; }

static size_t chroma_size(int32_t width, int32_t height, bool is_halved) {
  return is_halved ? halves(width) * halves(height) : luma_size(width, height);
}

size_t cs_ycc_size(int32_t width, int32_t height, bool is_halved) {
  return luma_size(width, height) + 2 * chroma_size(width, height, is_halved);
}

/* ---------------------------------------------------------------- rows */

/* Pixels of a stored row: an even number. */
static size_t row_pixels(const cs_ycc *ycc) { return 2 * halves(ycc->width); }

static size_t rows_size(const cs_ycc *ycc) { return 2 * row_pixels(ycc) * sizeof *ycc->rows; }

static celspan_status open_rows(void *user, celspan_context *context, void **rows) {
  *rows = cs_mem_resize(context->memory, NULL, 0, rows_size(user));
  return *rows ? CELSPAN_OK : cs_fail_memory(context);
}

static void close_rows(void *user, celspan_context *context, void *rows) {
  cs_mem_free(context->memory, rows, rows ? rows_size(user) : 0);
}

/* Converts row y, or the pair of rows that ends with it. */
static void put_chroma(const cs_ycc *ycc, int32_t y, const uint32_t *rows, const uint32_t *row) {
  size_t size = chroma_size(ycc->width, ycc->height, ycc->is_halved);
  unsigned char *cb = ycc->bytes + luma_size(ycc->width, ycc->height), *cr = cb + size;
  if (!ycc->is_halved) {
    size_t offset = (size_t)y * (size_t)ycc->width;
    CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_chroma)(row, ycc->width, cb + offset, cr + offset);
  } else if (y % 2 == 1 || y == ycc->height - 1) {
    int32_t count = (int32_t)halves(ycc->width);
    size_t offset = (size_t)(y / 2) * (size_t)count;
    CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_halved)(rows, row, count, cb + offset, cr + offset);
  }
}

/* rows: two rows, owned by the thread. */
static celspan_status fill_row(void *user, void *rows, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  const cs_ycc *ycc = user;
  uint32_t *row = (uint32_t *)rows + (size_t)(y % 2) * row_pixels(ycc);
  (void)context;
  cs_coder_row(&ycc->coder, y, spans, span_count, row);
  row[row_pixels(ycc) - 1] = row[ycc->width - 1];
  CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_luma)
  (row, ycc->width, ycc->bytes + (size_t)y * (size_t)ycc->width);
  put_chroma(ycc, y, rows, row);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_ycc *ycc = user;
  void *rows;
  ycc->width = width;
  ycc->height = height;
  CS_TRY(open_rows(ycc, context, &rows));
  ycc->rows = rows;
  return CELSPAN_OK;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  return fill_row(user, ((cs_ycc *)user)->rows, context, y, spans, span_count);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_ycc *ycc = user;
  close_rows(ycc, context, ycc->rows);
  ycc->rows = NULL;
  return outcome;
}

celspan_sink cs_ycc_sink(cs_ycc *ycc) {
  ycc->rows = NULL;
  return (celspan_sink){CS_SINK_CALLS, .user = ycc,
                        .takes_codes =
                            !ycc->coder.dithers && cs_pixels_takes_codes(&ycc->coder.coding)};
}

const cs_coder *cs_ycc_sink_coder(const celspan_sink *sink) {
  return sink->row == put_row ? &((const cs_ycc *)sink->user)->coder : NULL;
}

bool cs_ycc_sink_shares(const celspan_sink *sink, cs_shares *out) {
  if (sink->row != put_row)
    return false;
  const cs_ycc *ycc = sink->user;
  *out = (cs_shares){.user = sink->user,
                     .rows = ycc->is_halved ? SHARE_ROWS : 0,
                     .open_worker = open_rows,
                     .close_worker = close_rows,
                     .row = fill_row};
  return true;
}
