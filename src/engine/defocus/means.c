#include "engine/defocus/means.h"

static celspan_status fill_rows(cs_row_maker *maker, cs_row *row, size_t columns, int32_t first,
                                int32_t end, float (*nodes)[4]) {
  for (int32_t y = first; y < end; y++, nodes += columns) {
    CS_TRY(cs_row_make(maker, y, row));
    for (size_t i = 0; i < row->count; i++)
      cs_row_spread_span(&row->spans[i], row->spans[i].x0, row->spans[i].x1,
                         (cs_v4 *)(void *)nodes[row->spans[i].x0]);
  }
  return CELSPAN_OK;
}

celspan_status cs_means_fill(celspan_context *context, cs_row_maker *maker, int32_t columns,
                             int32_t first, int32_t end, float (*nodes)[4]) {
  cs_row row;
  cs_row_init(&row);
  celspan_status status = fill_rows(maker, &row, (size_t)columns, first, end, nodes);
  cs_row_finish(&row, context->memory);
  return status;
}
