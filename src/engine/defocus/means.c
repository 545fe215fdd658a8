#include "engine/defocus/means.h"

#include <stddef.h>

static celspan_status fill_rows(cs_row_maker *maker, cs_row *row, int32_t first, int32_t end,
                                size_t columns, float (*nodes)[4]) {
  for (int32_t y = first; y < end; y++, nodes += columns) {
    CS_TRY(cs_row_make(maker, y, row));
    for (size_t i = 0; i < row->count; i++)
      cs_row_spread_span(&row->spans[i], row->spans[i].x0, row->spans[i].x1,
                         (cs_v4 *)(void *)nodes[row->spans[i].x0]);
  }
  return CELSPAN_OK;
}

static celspan_status fill_plane(const cs_defocus *own, celspan_context *context, int plane,
                                 int32_t first, int32_t end, float (*nodes)[4]) {
  cs_row_maker maker;
  cs_row row;
  cs_row_init(&row);
  celspan_status status = cs_row_maker_init(&maker, context, &own->plans[plane]);
  if (status == CELSPAN_OK)
    status = fill_rows(&maker, &row, first, end, (size_t)own->grid.columns, nodes);
  cs_row_finish(&row, context->memory);
  cs_row_maker_finish(&maker);
  return status;
}

static celspan_status make_band(const void *layer, celspan_context *context, int32_t number,
                                cs_defocus_band *band) {
  const cs_defocus *own = layer;
  const cs_defocused *grid = &own->grid;
  int32_t first = number * grid->band_rows;
  int32_t end = grid->rows - first < grid->band_rows ? grid->rows : first + grid->band_rows;
  size_t size = (size_t)grid->band_rows * (size_t)grid->columns;
  CS_TRY(cs_defocus_band_room(grid, context, band));
  for (int plane = 0; plane < grid->planes; plane++)
    CS_TRY(fill_plane(own, context, plane, first, end, band->nodes + (size_t)plane * size));
  return CELSPAN_OK;
}

static celspan_status acquire(const cs_defocused *grid, celspan_context *context, int32_t number,
                              cs_defocus_band **out) {
  const cs_defocus *own =
      (const cs_defocus *)(const void *)((const char *)grid - offsetof(cs_defocus, grid));
  const cs_defocus_bands_key key = {own->key, number};
  return cs_defocus_bands_acquire(context, &key, make_band, own, out);
}

void cs_means_use(cs_defocus *own) { own->grid.acquire = acquire; }
