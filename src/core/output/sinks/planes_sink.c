#include "output/sinks/planes_sink.h"

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

size_t cs_planes_size(int32_t width, int32_t height, bool is_halved) {
  return luma_size(width, height) + 2 * chroma_size(width, height, is_halved);
}

/* ---------------------------------------------------------------- rows */

/* Pixels of a stored row: an even number. */
static size_t row_pixels(const cs_planes *planes) { return 2 * halves(planes->width); }

static size_t rows_size(const cs_planes *planes) {
  return 2 * row_pixels(planes) * sizeof *planes->rows;
}

static celspan_status open_rows(void *user, celspan_context *context, void **rows) {
  *rows = cs_mem_resize(context->memory, NULL, 0, rows_size(user));
  return *rows ? CELSPAN_OK : cs_fail_memory(context);
}

static void close_rows(void *user, celspan_context *context, void *rows) {
  cs_mem_free(context->memory, rows, rows ? rows_size(user) : 0);
}

/* Converts row y, or the pair of rows that ends with it. */
static void put_chroma(const cs_planes *planes, int32_t y, const uint32_t *rows,
                       const uint32_t *row) {
  size_t size = chroma_size(planes->width, planes->height, planes->is_halved);
  unsigned char *cb = planes->bytes + luma_size(planes->width, planes->height), *cr = cb + size;
  if (!planes->is_halved) {
    size_t offset = (size_t)y * (size_t)planes->width;
    CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_chroma)(row, planes->width, cb + offset, cr + offset);
  } else if (y % 2 == 1 || y == planes->height - 1) {
    int32_t count = (int32_t)halves(planes->width);
    size_t offset = (size_t)(y / 2) * (size_t)count;
    CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_halved)(rows, row, count, cb + offset, cr + offset);
  }
}

/* rows: two rows, owned by the thread. */
static celspan_status fill_row(void *user, void *rows, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  const cs_planes *planes = user;
  uint32_t *row = (uint32_t *)rows + (size_t)(y % 2) * row_pixels(planes);
  (void)context;
  cs_coder_row(&planes->coder, y, spans, span_count, row);
  row[row_pixels(planes) - 1] = row[planes->width - 1];
  CS_WIDE_CHOOSE(cs_isa_best(), cs_ycbcr_luma)
  (row, planes->width, planes->bytes + (size_t)y * (size_t)planes->width);
  put_chroma(planes, y, rows, row);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the sink */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_planes *planes = user;
  void *rows;
  planes->width = width;
  planes->height = height;
  CS_TRY(open_rows(planes, context, &rows));
  planes->rows = rows;
  return CELSPAN_OK;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  return fill_row(user, ((cs_planes *)user)->rows, context, y, spans, span_count);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_planes *planes = user;
  close_rows(planes, context, planes->rows);
  planes->rows = NULL;
  return outcome;
}

celspan_sink cs_planes_sink(cs_planes *planes) {
  planes->rows = NULL;
  return (celspan_sink){CS_SINK_CALLS, .user = planes,
                        .takes_codes =
                            !planes->coder.dithers && cs_pixels_takes_codes(&planes->coder.coding)};
}

const cs_coder *cs_planes_sink_coder(const celspan_sink *sink) {
  return sink->row == put_row ? &((const cs_planes *)sink->user)->coder : NULL;
}

bool cs_planes_sink_shares(const celspan_sink *sink, cs_shares *out) {
  if (sink->row != put_row)
    return false;
  const cs_planes *planes = sink->user;
  *out = (cs_shares){.user = sink->user,
                     .rows = planes->is_halved ? SHARE_ROWS : 0,
                     .open_worker = open_rows,
                     .close_worker = close_rows,
                     .row = fill_row};
  return true;
}
