#include "engine/defocus/regrid.h"

#include "base/number.h"
#include "base/vector.h"

/* ---------------------------------------------------------------- places */

/* The node before a place, and the weights of the cubic through the four nodes around it. The
 * weight of the node before the place is left out: it is 1 minus the other weights. last: the last
 * node. */
static int32_t find_place(double at, int32_t last, float weights[3]) {
  at = cs_number_clamp(at, 0, last);
  int32_t before = cs_number_floor(at);
  double t = at - before;
  weights[0] = (float)(-t * (t - 1) * (t - 2) / 6);
  weights[1] = (float)(-t * (t + 1) * (t - 2) / 2);
  weights[2] = (float)(t * (t + 1) * (t - 1) / 6);
  return before;
}

/* The place of node `k` of the frame's grid in pixels, and the same place counted in the cel's own
 * nodes. */
static double pixel_of(double pitch, int32_t k) { return (k - 0.5) * pitch; }

static double place_of(const cs_regrid_axis *axis, double pixel) {
  return pixel * axis->scale + axis->offset + 0.5;
}

/* ---------------------------------------------------------------- life */

static void find_columns(cs_regrid_rows *rows) {
  const cs_defocused *to = rows->to;
  int32_t last = rows->map->from->columns - 1;
  for (int32_t x = 0; x < to->columns; x++) {
    double at = place_of(&rows->map->axes[0], pixel_of(to->pitch_x, to->first_x + x));
    rows->columns[x].first = find_place(at, last, rows->columns[x].weights);
  }
}

static void drop_band(cs_regrid_rows *rows, int i) {
  const cs_defocused *from = rows->map->from;
  if (rows->bands[i])
    from->release(from, rows->context, rows->bands[i]);
  rows->bands[i] = NULL;
}

static void finish_rows(cs_regrid_rows *rows) {
  drop_band(rows, 0);
  drop_band(rows, 1);
  CS_ARRAYS_FREE(rows->context->memory, rows, columns, mixed);
}

void cs_regrid_forget(celspan_context *context, cs_defocused_view *view) {
  if (view->rows)
    finish_rows(view->rows);
  cs_mem_free(context->memory, view->rows, sizeof *view->rows);
  view->rows = NULL;
}

static celspan_status begin_rows(const cs_regrid *map, const cs_defocused *to,
                                 celspan_context *context, cs_defocused_view *view) {
  CS_TRY(CS_MAKE(context, view->rows, 1));
  cs_regrid_rows *rows = view->rows;
  *rows = (cs_regrid_rows){.map = map, .to = to, .context = context, .isa = cs_isa_best()};
  celspan_status status = CS_ARRAY_MAKE(context, rows->columns, (size_t)to->columns);
  if (status == CELSPAN_OK)
    status = CS_ARRAY_MAKE(context, rows->mixed, (size_t)map->from->columns + 3);
  if (status == CELSPAN_OK)
    find_columns(rows);
  else
    cs_regrid_forget(context, view);
  return status;
}

/* ---------------------------------------------------------------- a row */

/* A row of the cel's own nodes. The four rows that are mixed lie in at most two bands, one after
 * the other. */
static celspan_status find_row(cs_regrid_rows *rows, int plane, int32_t row, const float **out) {
  const cs_defocused *from = rows->map->from;
  int32_t number = row / from->band_rows;
  int i = number % 2;
  if (!rows->bands[i] || rows->numbers[i] != number) {
    drop_band(rows, i);
    CS_TRY(from->acquire(from, rows->context, number, &rows->bands[i]));
    rows->numbers[i] = number;
  }
  size_t at = (size_t)plane * (size_t)from->band_rows + (size_t)(row % from->band_rows);
  *out = rows->bands[i]->nodes[at * (size_t)from->columns];
  return CELSPAN_OK;
}

/* y: pixels of the frame. */
static celspan_status mix_rows(cs_regrid_rows *rows, int plane, double y) {
  const cs_defocused *from = rows->map->from;
  const float *four[4];
  float weights[3], (*mixed)[4] = rows->mixed + 1;
  int32_t last = from->rows - 1, end = from->columns;
  int32_t before = find_place(place_of(&rows->map->axes[1], y), last, weights);
  for (int32_t k = 0; k < 4; k++) {
    int32_t row = before - 1 + k;
    CS_TRY(find_row(rows, plane, row < 0 ? 0 : row > last ? last : row, &four[k]));
  }
  CS_WIDE_CHOOSE(rows->isa, cs_regrid_mix)(four, weights, 4 * (size_t)end, mixed[0]);
  memcpy(mixed[-1], mixed[0], sizeof *mixed);
  memcpy(mixed[end], mixed[end - 1], sizeof *mixed);
  memcpy(mixed[end + 1], mixed[end - 1], sizeof *mixed);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what a row has */

/* The first column that reads the nodes of the mixed row with this number or a higher one. */
static int32_t first_beyond(const cs_regrid_rows *rows, int32_t nodes) {
  int32_t low = 0, high = rows->to->columns;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (rows->columns[middle].first >= nodes)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* The plane of S comes first: its matte says which columns are clear. */
static celspan_status mix_visible(cs_regrid_rows *rows, int plane, double y, float (*nodes)[4],
                                  cs_defocused_range *visible) {
  const float(*mixed)[4] = (const float(*)[4])rows->mixed;
  CS_TRY(mix_rows(rows, plane, y));
  if (plane == 0) {
    cs_defocused_range seen = CS_WIDE_CHOOSE(rows->isa, cs_regrid_visible)(
        mixed, (cs_defocused_range){0, rows->map->from->columns + 3});
    visible->end = first_beyond(rows, seen.end);
    visible->first = seen.first < seen.end ? first_beyond(rows, seen.first - 3) : visible->end;
  }
  CS_WIDE_CHOOSE(rows->isa, cs_regrid_across)
  (rows->columns + visible->first, visible->end - visible->first, mixed, nodes + visible->first);
  return CELSPAN_OK;
}

celspan_status cs_regrid_row(const cs_regrid *map, const cs_defocused *to, celspan_context *context,
                             cs_defocused_view *view, double y) {
  if (!view->rows)
    CS_TRY(begin_rows(map, to, context, view));
  cs_defocused_range visible;
  for (int plane = 0; plane < to->planes; plane++)
    CS_TRY(mix_visible(view->rows, plane, y, view->mixed + (size_t)plane * (size_t)to->columns,
                       &visible));
  view->visible = visible;
  return CELSPAN_OK;
}
