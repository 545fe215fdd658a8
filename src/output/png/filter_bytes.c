#include "output/png/filter_bytes.h"

static cs_png_filter choose(cs_isa isa, cs_png_filter most, size_t pixel_size, size_t size,
                            const unsigned char *row, const unsigned char *above) {
  uint64_t costs[CS_PNG_FILTERS] = {0};
  for (size_t at = 0; at < size; at += CS_PNG_COST_MOST) {
    size_t count = size - at < CS_PNG_COST_MOST ? size - at : CS_PNG_COST_MOST;
    CS_WIDE_CHOOSE(isa, cs_png_bytes_add_costs)(row + at, above + at, pixel_size, count, costs);
  }
  int best = CS_PNG_NONE;
  for (int kind = CS_PNG_SUB; kind <= (int)most; kind++)
    if (costs[kind] < costs[best])
      best = kind;
  return (cs_png_filter)best;
}

celspan_status cs_png_filter_bytes_put(cs_deflate *deflate, celspan_context *context,
                                       cs_png_filter most, size_t pixel_size, size_t size,
                                       const unsigned char *row, const unsigned char *above) {
  cs_isa isa = cs_isa_best();
  cs_png_filter chosen = choose(isa, most, pixel_size, size, row, above);
  unsigned char *out = cs_deflate_space(deflate, context);
  *out = (unsigned char)chosen;
  CS_TRY(cs_deflate_commit(deflate, out, 1));
  for (size_t at = 0; at < size; at += CS_DEFLATE_SPACE) {
    size_t count = size - at < CS_DEFLATE_SPACE ? size - at : CS_DEFLATE_SPACE;
    out = cs_deflate_space(deflate, context);
    CS_WIDE_CHOOSE(isa, cs_png_bytes_filter)(chosen, row + at, above + at, pixel_size, count, out);
    CS_TRY(cs_deflate_commit(deflate, out, count));
  }
  return CELSPAN_OK;
}
