#include "output/sink_shares.h"

bool cs_sink_shares(const celspan_sink *sink, cs_shares *out) {
  *out = (cs_shares){.rows = 0};
  return !sink->row || cs_memory_sink_shares(sink, out) || cs_png_sink_shares(sink, out) ||
         cs_span_sink_shares(sink, out);
}
