#include "output/shares.h"

bool cs_shares_of_sink(const celspan_sink *sink, cs_shares *out) {
  *out = (cs_shares){.rows = 0};
  return !sink->row || cs_memory_shares(sink, out) || cs_png_shares(sink, out);
}
