#include "output/sink.h"

/* Every sink's `end` takes an outcome that is not OK at any time, begun or not. */
void cs_sink_discard(celspan_context *context, celspan_sink *sink) {
  if (sink->end)
    (void)sink->end(sink->user, context, CELSPAN_CANCELLED);
  *sink = (celspan_sink){0};
}
