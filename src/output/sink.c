#include "output/sink.h"

/* Every sink's `end` may be called with a failure at any time, even before `begin`. */
void cs_sink_discard(celspan_context *context, celspan_sink *sink) {
  if (sink->end)
    (void)sink->end(sink->user, context, CELSPAN_CANCELLED);
  *sink = (celspan_sink){0};
}
