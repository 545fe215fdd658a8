#include "output/parts.h"

bool cs_sink_parts(const celspan_sink *sink, cs_parts *out) {
  *out = (cs_parts){.rows = 0};
  return !sink->row || cs_memory_parts(sink, out) || cs_png_parts(sink, out);
}
