#include "output/sinks/dither.h"

#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"

/* ---------------------------------------------------------------- a row */

/* Bayer's thresholds: (2 k + 1)/512 for a k of 0..255, each once in 16 x 16 pixels. k consists of
 * alternate bits of x ^ y and of y, the lowest first, so that the thresholds of neighbours differ
 * much. */
static float threshold(uint32_t x, uint32_t y) {
  uint32_t k = 0, mixed = x ^ y;
  for (int bit = 0; bit < 4; bit++)
    k = k << 2 | (mixed >> bit & 1) << 1 | (y >> bit & 1);
  return (float)(2 * k + 1) / 512;
}

/* Whether the vectorized functions support the coding. */
static bool is_usual(const celspan_coding *coding) {
  return coding->transfer == CELSPAN_TRANSFER_SRGB && coding->alpha <= CELSPAN_ALPHA_PREMULTIPLIED;
}

void cs_dither_row(const celspan_coding *coding, int32_t x, int32_t y, const celspan_span *spans,
                   size_t span_count, unsigned char *row) {
  cs_dither_lifts lifts;
  for (uint32_t i = 0; i < CS_DITHER_PERIOD; i++)
    lifts.of[i] = lifts.of[i + CS_DITHER_PERIOD] = 1 - threshold(i, (uint32_t)y);
  cs_isa isa = is_usual(coding) ? cs_isa_best() : CS_ISA_ANY;
  CS_WIDE_CHOOSE(isa, cs_dither_spans)(coding, &lifts, x, spans, span_count, row);
}

/* ---------------------------------------------------------------- the sink */

typedef struct dither_sink {
  celspan_sink inner;
  celspan_coding coding;
  int32_t x, y;
  int32_t width;
  unsigned char *row; /* from begin to end */
  cs_shares shares;   /* of the inner sink, if there are several threads */
} dither_sink;

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  dither_sink *sink = user;
  sink->width = width;
  sink->row = cs_mem_array(context->memory, (size_t)width, 4);
  if (!sink->row)
    return cs_fail_memory(context);
  return sink->inner.begin(sink->inner.user, context, width, height);
}

/* The inner sink gets the final bytes, which are in `row`. */
static celspan_span dither(const dither_sink *sink, int32_t y, const celspan_span *spans,
                           size_t span_count, unsigned char *row) {
  cs_dither_row(&sink->coding, sink->x, sink->y + y, spans, span_count, row);
  return (celspan_span){.x1 = sink->width, .kind = CELSPAN_SPAN_ARRAY, .codes = row};
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  dither_sink *sink = user;
  const celspan_span coded = dither(sink, y, spans, span_count, sink->row);
  return sink->inner.row(sink->inner.user, context, y, &coded, 1);
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  dither_sink *sink = user;
  outcome = sink->inner.end(sink->inner.user, context, outcome);
  cs_mem_free(context->memory, sink->row, 4 * (size_t)sink->width);
  cs_mem_free(context->memory, sink, sizeof *sink);
  return outcome;
}

celspan_status cs_dither_sink(celspan_context *context, const celspan_coding *asked,
                              const celspan_coding *coding, int32_t x, int32_t y,
                              celspan_sink *sink) {
  if (!asked || asked->depth != CELSPAN_DEPTH_8_DITHER)
    return CELSPAN_OK;
  dither_sink *dither = cs_mem_array(context->memory, 1, sizeof *dither);
  if (!dither) {
    cs_sink_discard(context, sink);
    return cs_fail_memory(context);
  }
  *dither = (dither_sink){.inner = *sink, .coding = *coding, .x = x, .y = y};
  *sink = (celspan_sink){CS_SINK_CALLS, .user = dither};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- several threads */

/* A worker of the inner sink, and a row for it. */
typedef struct dither_worker {
  const dither_sink *sink;
  void *inner;
  unsigned char *row;
} dither_worker;

static void close_worker(void *user, celspan_context *context, void *made) {
  const dither_sink *sink = user;
  dither_worker *worker = made;
  if (!worker)
    return;
  if (sink->shares.close_worker)
    sink->shares.close_worker(sink->shares.user, context, worker->inner);
  cs_mem_free(context->memory, worker->row, 4 * (size_t)sink->width);
  cs_mem_free(context->memory, worker, sizeof *worker);
}

static celspan_status open_worker(void *user, celspan_context *context, void **made) {
  const dither_sink *sink = user;
  dither_worker *worker;
  CS_TRY(CS_MAKE(context, worker, 1));
  *made = worker;
  worker->sink = sink;
  worker->row = cs_mem_array(context->memory, (size_t)sink->width, 4);
  if (!worker->row)
    return cs_fail_memory(context);
  return sink->shares.open_worker
             ? sink->shares.open_worker(sink->shares.user, context, &worker->inner)
             : CELSPAN_OK;
}

static celspan_status open_share(void *user, celspan_context *context, void **share) {
  const cs_shares *shares = &((const dither_sink *)user)->shares;
  return shares->open_share ? shares->open_share(shares->user, context, share) : CELSPAN_OK;
}

static void close_share(void *user, celspan_context *context, void *share) {
  const cs_shares *shares = &((const dither_sink *)user)->shares;
  if (shares->close_share)
    shares->close_share(shares->user, context, share);
}

static celspan_status begin_share(void *made, celspan_context *context, void *share,
                                  int32_t index) {
  const dither_worker *worker = made;
  const cs_shares *shares = &worker->sink->shares;
  return shares->begin ? shares->begin(worker->inner, context, share, index) : CELSPAN_OK;
}

/* Dithers into the place of the pixels, if the inner sink has one. */
static celspan_status put_share_row(void *user, void *made, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  const dither_sink *sink = user;
  const dither_worker *worker = made;
  const cs_shares *shares = &sink->shares;
  unsigned char *row =
      shares->pixels ? shares->pixels(shares->user, worker->inner, y) : worker->row;
  const celspan_span coded = dither(sink, y, spans, span_count, row);
  return shares->row(shares->user, worker->inner, context, y, &coded, 1);
}

static celspan_status end_share(void *made, celspan_context *context) {
  const dither_worker *worker = made;
  const cs_shares *shares = &worker->sink->shares;
  return shares->end ? shares->end(worker->inner, context) : CELSPAN_OK;
}

static celspan_status join_share(void *user, celspan_context *context, void *share, int32_t index) {
  const cs_shares *shares = &((const dither_sink *)user)->shares;
  return shares->join ? shares->join(shares->user, context, share, index) : CELSPAN_OK;
}

const celspan_sink *cs_dither_sink_inner(const celspan_sink *sink) {
  return sink->row == put_row ? &((const dither_sink *)sink->user)->inner : sink;
}

void cs_dither_sink_shares(const celspan_sink *sink, cs_shares *shares) {
  if (sink->row != put_row)
    return;
  dither_sink *dithers = sink->user;
  dithers->shares = *shares;
  *shares = (cs_shares){.user = dithers,
                        .rows = shares->rows,
                        .takes_above = shares->takes_above,
                        CS_SHARES_CALLS,
                        .end = end_share};
}
