#include "engine/events/bundle.h"

/* The bundles of a row of tiles. */
static celspan_status make_row(celspan_context *context, const cs_cull *cull, int32_t row,
                               cs_courses *courses, cs_bundles *out) {
  const cs_deferred *all = cull->deferred_list;
  uint32_t end = cull->deferred_starts[row + 1];
  for (uint32_t first = cull->deferred_starts[row], k; first < end; first = k) {
    cs_bundle bundle = {.first = first};
    for (k = first; k < end && all[k].x == all[first].x; k++)
      bundle.change = cs_windings_add(bundle.change, all[k].layer, all[k].direction);
    bundle.count = k - first;
    cs_courses_add_upright(courses, all[first].x, cs_bundle_top(cull, row),
                           cs_bundle_top(cull, row + 1));
    CS_TRY(CS_ARRAY_APPEND(context, out->bundles, out->count, bundle));
  }
  return CELSPAN_OK;
}

celspan_status cs_bundles_make(celspan_context *context, const cs_cull *cull, cs_courses *courses,
                               cs_bundles *out) {
  *out = (cs_bundles){0};
  if (cull->tile_rows == 0)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_MAKE(context, out->starts, (size_t)cull->tile_rows + 1));
  for (int32_t row = 0; row < cull->tile_rows; row++) {
    CS_TRY(make_row(context, cull, row, courses, out));
    out->starts[row + 1] = (uint32_t)out->count;
  }
  return CELSPAN_OK;
}

void cs_bundles_finish(cs_bundles *bundles, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, bundles, bundles, starts);
  *bundles = (cs_bundles){0};
}
