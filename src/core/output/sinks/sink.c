#include "output/sinks/sink.h"

/* The `end` of every sink may be called with a failure at any time, even before `begin`. */
void cs_sink_discard(celspan_context *context, celspan_sink *sink) {
  if (sink->end)
    (void)sink->end(sink->user, context, CELSPAN_CANCELLED);
  *sink = (celspan_sink){0};
}

/* ---------------------------------------------------------------- two sinks */

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  cs_tee *tee = user;
  celspan_status status = CELSPAN_OK;
  for (int i = 0; i < 2 && status == CELSPAN_OK; i++)
    status = tee->sinks[i].begin(tee->sinks[i].user, context, width, height);
  return status;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  cs_tee *tee = user;
  celspan_status status = CELSPAN_OK;
  for (int i = 0; i < 2 && status == CELSPAN_OK; i++)
    status = tee->sinks[i].row(tee->sinks[i].user, context, y, spans, span_count);
  return status;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  cs_tee *tee = user;
  tee->is_ended = true;
  for (int i = 0; i < 2; i++)
    outcome = tee->sinks[i].end(tee->sinks[i].user, context, outcome);
  return outcome;
}

celspan_sink cs_tee_sink(cs_tee *tee) {
  tee->is_ended = false;
  return (celspan_sink){sizeof(celspan_sink),
                        tee,
                        begin,
                        put_row,
                        end,
                        tee->sinks[0].takes_codes && tee->sinks[1].takes_codes};
}
