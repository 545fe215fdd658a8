/* Pixels into the caller's memory; for measurements, into one row for each thread, which is
 * overwritten each time. */
#include "output/sinks/coder.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"

typedef struct memory_sink {
  cs_coder coder;
  unsigned char *pixels; /* NULL: rows are dropped */
  size_t stride;
  size_t row_size;
  unsigned char *row; /* the row that is used if rows are dropped */
} memory_sink;

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  memory_sink *sink = user;
  (void)height;
  sink->row_size = (size_t)width * cs_pixels_size(&sink->coder.coding);
  if (!sink->pixels)
    sink->row = cs_mem_array(context->memory, 1, sink->row_size);
  if (sink->pixels ? sink->stride >= sink->row_size : sink->row != NULL)
    return CELSPAN_OK;
  if (!sink->pixels)
    return cs_fail_memory(context);
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "the stride is %zu bytes; a row of %d pixels needs at least %zu", sink->stride,
                 (int)width, sink->row_size);
}

/* worker: the thread's row, if rows are dropped; NULL: the sink's row. */
static unsigned char *row_pixels(void *user, void *worker, int32_t y) {
  const memory_sink *sink = user;
  unsigned char *own = worker ? worker : sink->row;
  return sink->pixels ? sink->pixels + (size_t)y * sink->stride : own;
}

static celspan_status fill_row(void *user, void *worker, celspan_context *context, int32_t y,
                               const celspan_span *spans, size_t span_count) {
  const memory_sink *sink = user;
  (void)context;
  cs_coder_row(&sink->coder, y, spans, span_count, row_pixels(user, worker, y));
  return CELSPAN_OK;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  return fill_row(user, NULL, context, y, spans, span_count);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  memory_sink *sink = user;
  cs_mem_free(context->memory, sink->row, sink->row_size);
  cs_mem_free(context->memory, sink, sizeof *sink);
  return outcome;
}

celspan_status cs_sink_memory(celspan_context *context, const celspan_coding *coding, void *pixels,
                              size_t stride, celspan_sink *out) {
  memory_sink *sink;
  CS_TRY(CS_MAKE(context, sink, 1));
  sink->coder.coding = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  sink->pixels = pixels;
  sink->stride = stride;
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coder.coding)};
  return CELSPAN_OK;
}

const cs_coder *cs_memory_sink_coder(const celspan_sink *sink) {
  return sink->row == put_row ? &((const memory_sink *)sink->user)->coder : NULL;
}

/* ---------------------------------------------------------------- several threads */

static celspan_status open_worker(void *user, celspan_context *context, void **worker) {
  const memory_sink *sink = user;
  *worker = sink->pixels ? NULL : cs_mem_array(context->memory, 1, sink->row_size);
  return sink->pixels || *worker ? CELSPAN_OK : cs_fail_memory(context);
}

static void close_worker(void *user, celspan_context *context, void *worker) {
  cs_mem_free(context->memory, worker, ((const memory_sink *)user)->row_size);
}

bool cs_memory_sink_shares(const celspan_sink *sink, cs_shares *out) {
  if (sink->row != put_row)
    return false;
  *out = (cs_shares){.user = sink->user,
                     .open_worker = open_worker,
                     .close_worker = close_worker,
                     .row = fill_row,
                     .pixels = sink->takes_codes ? row_pixels : NULL};
  return true;
}
