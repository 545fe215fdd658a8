#include "output/sinks/dither.h"

#include "output/sinks/pixels.h"
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
  for (uint32_t i = 0; i < CS_DITHER_PERIOD; i++) {
    float lift = 1 - threshold(i, (uint32_t)y);
    for (int c = 0; c < 4; c++)
      lifts.of[i][c] = lifts.of[i + CS_DITHER_PERIOD][c] = lift;
  }
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
} dither_sink;

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  dither_sink *sink = user;
  sink->width = width;
  sink->row = cs_mem_array(context->memory, (size_t)width, 4);
  if (!sink->row)
    return cs_fail_memory(context);
  return sink->inner.begin(sink->inner.user, context, width, height);
}

/* The inner sink gets the final bytes. */
static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  dither_sink *sink = user;
  cs_dither_row(&sink->coding, sink->x, sink->y + y, spans, span_count, sink->row);
  const celspan_span coded = {.x1 = sink->width, .kind = CELSPAN_SPAN_ARRAY, .codes = sink->row};
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
