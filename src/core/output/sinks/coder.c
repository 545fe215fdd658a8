#include "output/sinks/coder.h"

#include "output/sinks/dither.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"

/* ---------------------------------------------------------------- a row */

cs_coder cs_coder_of(const celspan_coding *asked, int32_t x, int32_t y) {
  return (cs_coder){.coding = cs_pixels_resolve(asked, CELSPAN_DEPTH_8),
                    .dithers = asked && asked->depth == CELSPAN_DEPTH_8_DITHER,
                    .x = x,
                    .y = y};
}

/* Whether the row was coded before. */
static bool is_coded(const celspan_span *spans, size_t span_count) {
  return span_count == 1 && spans->kind == CELSPAN_SPAN_ARRAY && spans->codes;
}

void cs_coder_row(const cs_coder *coder, int32_t y, const celspan_span *spans, size_t span_count,
                  void *row) {
  if (coder->dithers && !is_coded(spans, span_count))
    cs_dither_row(&coder->coding, coder->x, coder->y + y, spans, span_count, row);
  else
    cs_pixels_row(&coder->coding, spans, span_count, row);
}

/* ---------------------------------------------------------------- the sink */

typedef struct coder_sink {
  celspan_sink inner;
  cs_coder coder;
  int32_t width;
  unsigned char *row; /* from begin to end */
  unsigned char *aim; /* where rows are coded instead, or NULL */
  cs_shares shares;   /* the shares of the inner sink, if there are several threads */
} coder_sink;

static size_t row_size(const coder_sink *sink) {
  return (size_t)sink->width * cs_pixels_size(&sink->coder.coding);
}

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  coder_sink *sink = user;
  sink->width = width;
  CS_TRY(cs_mem_make(context, (void **)&sink->row, 1, row_size(sink)));
  return sink->inner.begin(sink->inner.user, context, width, height);
}

/* The inner sink gets the final bytes, which are in `row` unless the row was coded before. */
static celspan_span code(const coder_sink *sink, int32_t y, const celspan_span *spans,
                         size_t span_count, unsigned char *row) {
  if (is_coded(spans, span_count))
    return *spans;
  cs_coder_row(&sink->coder, y, spans, span_count, row);
  return (celspan_span){.x1 = sink->width, .kind = CELSPAN_SPAN_ARRAY, .codes = row};
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  coder_sink *sink = user;
  const celspan_span coded = code(sink, y, spans, span_count, sink->aim ? sink->aim : sink->row);
  return sink->inner.row(sink->inner.user, context, y, &coded, 1);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  coder_sink *sink = user;
  outcome = sink->inner.end(sink->inner.user, context, outcome);
  cs_mem_free(context->memory, sink->row, row_size(sink));
  cs_mem_free(context->memory, sink, sizeof *sink);
  return outcome;
}

celspan_status cs_coder_sink(celspan_context *context, const cs_coder *coder, celspan_sink *sink) {
  coder_sink *made = cs_mem_array(context->memory, 1, sizeof *made);
  if (!made) {
    cs_sink_discard(context, sink);
    return cs_fail_memory(context);
  }
  *made = (coder_sink){.inner = *sink, .coder = *coder};
  *sink = (celspan_sink){CS_SINK_CALLS, .user = made,
                         .takes_codes = !coder->dithers && cs_pixels_takes_codes(&coder->coding)};
  return CELSPAN_OK;
}

void cs_coder_aim(const celspan_sink *sink, unsigned char *row) {
  ((coder_sink *)sink->user)->aim = row;
}

celspan_status cs_coder_dither(celspan_context *context, const celspan_coding *asked,
                               const celspan_coding *coding, int32_t x, int32_t y,
                               celspan_sink *sink) {
  if (!asked || asked->depth != CELSPAN_DEPTH_8_DITHER)
    return CELSPAN_OK;
  return cs_coder_sink(context, &(cs_coder){*coding, x, y, .dithers = true}, sink);
}

/* ---------------------------------------------------------------- several threads */

/* A worker of the inner sink, and a row for it. */
typedef struct coder_worker {
  const coder_sink *sink;
  void *inner;
  unsigned char *row;
} coder_worker;

static void close_worker(void *user, celspan_context *context, void *made) {
  const coder_sink *sink = user;
  coder_worker *worker = made;
  if (!worker)
    return;
  if (sink->shares.close_worker)
    sink->shares.close_worker(sink->shares.user, context, worker->inner);
  cs_mem_free(context->memory, worker->row, row_size(sink));
  cs_mem_free(context->memory, worker, sizeof *worker);
}

static celspan_status open_worker(void *user, celspan_context *context, void **made) {
  const coder_sink *sink = user;
  coder_worker *worker;
  CS_TRY(CS_MAKE(context, worker, 1));
  *made = worker;
  worker->sink = sink;
  CS_TRY(cs_mem_make(context, (void **)&worker->row, 1, row_size(sink)));
  return sink->shares.open_worker
             ? sink->shares.open_worker(sink->shares.user, context, &worker->inner)
             : CELSPAN_OK;
}

static celspan_status open_share(void *user, celspan_context *context, void **share) {
  const cs_shares *shares = &((const coder_sink *)user)->shares;
  return shares->open_share ? shares->open_share(shares->user, context, share) : CELSPAN_OK;
}

static void close_share(void *user, celspan_context *context, void *share) {
  const cs_shares *shares = &((const coder_sink *)user)->shares;
  if (shares->close_share)
    shares->close_share(shares->user, context, share);
}

static celspan_status begin_share(void *made, celspan_context *context, void *share,
                                  int32_t index) {
  const coder_worker *worker = made;
  const cs_shares *shares = &worker->sink->shares;
  return shares->begin ? shares->begin(worker->inner, context, share, index) : CELSPAN_OK;
}

/* Codes into the place of the pixels, if the inner sink has one. */
static celspan_status put_share_row(void *user, void *made, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  const coder_sink *sink = user;
  const coder_worker *worker = made;
  const cs_shares *shares = &sink->shares;
  unsigned char *row =
      shares->pixels ? shares->pixels(shares->user, worker->inner, y) : worker->row;
  const celspan_span coded = code(sink, y, spans, span_count, row);
  return shares->row(shares->user, worker->inner, context, y, &coded, 1);
}

static celspan_status end_share(void *made, celspan_context *context) {
  const coder_worker *worker = made;
  const cs_shares *shares = &worker->sink->shares;
  return shares->end ? shares->end(worker->inner, context) : CELSPAN_OK;
}

static celspan_status join_share(void *user, celspan_context *context, void *share, int32_t index) {
  const cs_shares *shares = &((const coder_sink *)user)->shares;
  return shares->join ? shares->join(shares->user, context, share, index) : CELSPAN_OK;
}

const cs_coder *cs_coder_sink_own(const celspan_sink *sink) {
  return sink->row == put_row ? &((const coder_sink *)sink->user)->coder : NULL;
}

const celspan_sink *cs_coder_sink_inner(const celspan_sink *sink) {
  return sink->row == put_row ? &((const coder_sink *)sink->user)->inner : sink;
}

void cs_coder_sink_shares(const celspan_sink *sink, cs_shares *shares) {
  if (sink->row != put_row)
    return;
  coder_sink *coder = sink->user;
  coder->shares = *shares;
  *shares = (cs_shares){.user = coder,
                        .rows = shares->rows,
                        .takes_above = shares->takes_above,
                        CS_SHARES_CALLS,
                        .end = end_share};
}
