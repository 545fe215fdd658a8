#include "engine/defocus/shifted_source.h"

#include "base/number.h"

#include <math.h>

celspan_status cs_shifted_source_begin(celspan_context *context, const cs_defocused *grid,
                                       cs_shifted_source *out) {
  *out = (cs_shifted_source){.grid = grid};
  if (!grid)
    return CELSPAN_OK;
  size_t bands = (size_t)((grid->rows + grid->band_rows - 1) / grid->band_rows);
  out->plane = 4 * (size_t)grid->band_rows * (size_t)grid->columns;
  CS_TRY(CS_ARRAY_MAKE(context, out->bands, bands));
  return CS_ARRAY_MAKE(context, out->rows, (size_t)grid->rows);
}

static void release(celspan_context *context, cs_shifted_source *source, int32_t first,
                    int32_t end) {
  for (int32_t k = first; k < end; k++)
    if (source->bands[k]) {
      source->grid->release(source->grid, context, source->bands[k]);
      source->bands[k] = NULL;
    }
}

void cs_shifted_source_end(celspan_context *context, cs_shifted_source *source) {
  if (!source->grid)
    return;
  if (source->bands)
    release(context, source, source->held.first, source->held.end);
  CS_ARRAYS_FREE(context->memory, source, rows, bands);
}

void cs_shifted_source_next(celspan_context *context, cs_shifted_source *source) {
  const cs_defocused_range held = source->held, used = source->used;
  if (used.first < used.end) {
    release(context, source, held.first, used.first);
    release(context, source, used.end, held.end);
    source->held = used;
  }
  source->used = (cs_defocused_range){0, 0};
}

/* The range that covers a range and [first, end). */
static cs_defocused_range both(cs_defocused_range range, int32_t first, int32_t end) {
  if (range.first == range.end)
    return (cs_defocused_range){first, end};
  return (cs_defocused_range){first < range.first ? first : range.first,
                              end > range.end ? end : range.end};
}

static celspan_status take_band(celspan_context *context, cs_shifted_source *source, int32_t k) {
  const cs_defocused *grid = source->grid;
  int32_t first = k * grid->band_rows;
  CS_TRY(grid->acquire(grid, context, k, &source->bands[k]));
  for (int32_t y = 0; y < grid->band_rows && first + y < grid->rows; y++)
    source->rows[first + y] = source->bands[k]->nodes[(size_t)y * (size_t)grid->columns];
  return CELSPAN_OK;
}

celspan_status cs_shifted_source_take(celspan_context *context, cs_shifted_source *source,
                                      double low, double high) {
  const cs_defocused *grid = source->grid;
  int32_t last = grid->rows - 1;
  /* two rows are mixed everywhere, at the borders, too */
  int32_t first = (int32_t)cs_number_clamp(floor(low), 0, last - 1) / grid->band_rows;
  int32_t end = (int32_t)cs_number_clamp(floor(high) + 1, 1, last) / grid->band_rows + 1;
  source->held = both(source->held, first, end);
  source->used = both(source->used, first, end);
  for (int32_t k = first; k < end; k++)
    if (!source->bands[k])
      CS_TRY(take_band(context, source, k));
  return CELSPAN_OK;
}
