#include "output/sink_shares.h"

#include "output/guard.h"

bool cs_sink_shares(const celspan_sink *sink, cs_shares *out) {
  const celspan_sink *inner = cs_guard_open(sink);
  *out = (cs_shares){.rows = 0};
  return !inner->row || cs_memory_sink_shares(inner, out) || cs_png_sink_shares(inner, out) ||
         cs_span_sink_shares(inner, out);
}
