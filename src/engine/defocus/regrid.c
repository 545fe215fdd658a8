#include "engine/defocus/regrid.h"

#include "base/number.h"
#include "base/vector.h"

#include <math.h>

/* ---------------------------------------------------------------- places */

/* The four nodes about a place and the weights of the cubic through them, except that of the second
 * node, which is 1 less the others. last: node. */
static void find_place(double at, int32_t last, int32_t nodes[4], float weights[3]) {
  at = cs_number_clamp(at, 0, last);
  int32_t before = cs_number_floor(at);
  double t = at - before;
  for (int k = 0; k < 4; k++)
    nodes[k] = (int32_t)cs_number_clamp(before - 1 + k, 0, last);
  weights[0] = (float)(-t * (t - 1) * (t - 2) / 6);
  weights[1] = (float)(-t * (t + 1) * (t - 2) / 2);
  weights[2] = (float)(t * (t + 1) * (t - 1) / 6);
}

/* Where node `k` of the frame's grid lies among the nodes of the cel's own. */
static double place_of(const cs_regrid_axis *axis, double pitch, int32_t k) {
  return (k - 0.5) * pitch * axis->scale + axis->offset + 0.5;
}

/* ---------------------------------------------------------------- life */

static void find_columns(cs_regrid_rows *rows) {
  const cs_defocused *to = rows->to;
  int32_t last = rows->map->from->columns - 1;
  rows->first = to->columns;
  rows->end = 0;
  for (int32_t x = 0; x < to->columns; x++) {
    double at = place_of(&rows->map->axes[0], to->pitch_x, x);
    cs_regrid_column *column = &rows->columns[x];
    find_place(at, last, column->at, column->weights);
    if (at > 0 && at < last) {
      rows->first = x < rows->first ? x : rows->first;
      rows->end = x + 1;
    }
  }
}

celspan_status cs_regrid_begin(const cs_regrid *map, const cs_defocused *to,
                               celspan_context *context, cs_regrid_rows *out) {
  cs_memory *memory = context->memory;
  *out = (cs_regrid_rows){.map = map, .to = to, .context = context, .isa = cs_isa_best()};
  out->columns = cs_mem_array(memory, (size_t)to->columns, sizeof *out->columns);
  out->mixed = cs_mem_array(memory, (size_t)map->from->columns, sizeof *out->mixed);
  if (!out->columns || !out->mixed)
    return cs_fail_memory(context);
  find_columns(out);
  return CELSPAN_OK;
}

static void drop_band(cs_regrid_rows *rows, int i) {
  const cs_defocused *from = rows->map->from;
  if (rows->bands[i])
    from->release(from, rows->context, rows->bands[i]);
  rows->bands[i] = NULL;
}

void cs_regrid_finish(cs_regrid_rows *rows) {
  cs_memory *memory = rows->context->memory;
  drop_band(rows, 0);
  drop_band(rows, 1);
  cs_mem_free(memory, rows->columns, (size_t)rows->to->columns * sizeof *rows->columns);
  cs_mem_free(memory, rows->mixed, (size_t)rows->map->from->columns * sizeof *rows->mixed);
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

static celspan_status mix_rows(cs_regrid_rows *rows, int plane, int32_t y) {
  const cs_defocused *from = rows->map->from;
  const float *four[4];
  int32_t at[4];
  float weights[3];
  find_place(place_of(&rows->map->axes[1], rows->to->pitch_y, y), from->rows - 1, at, weights);
  for (int k = 0; k < 4; k++)
    CS_TRY(find_row(rows, plane, at[k], &four[k]));
  CS_WIDE_CHOOSE(rows->isa, cs_regrid_mix)
  (four, weights, 4 * (size_t)from->columns, rows->mixed[0]);
  return CELSPAN_OK;
}

/* Light and mattes are not negative, and a matte is at most 1; a cubic may pass these bounds. */
static inline cs_v4 mix_column(const cs_regrid_rows *rows, int32_t x) {
  const cs_regrid_column *column = &rows->columns[x];
  const float(*nodes)[4] = (const float(*)[4])rows->mixed;
  cs_v4 centre = cs_v4_load(nodes[column->at[1]]);
  cs_v4 sum = column->weights[0] * (cs_v4_load(nodes[column->at[0]]) - centre) +
              column->weights[1] * (cs_v4_load(nodes[column->at[2]]) - centre) +
              column->weights[2] * (cs_v4_load(nodes[column->at[3]]) - centre);
  return cs_v4_min(cs_v4_max(centre + sum, cs_v4_all(0)), (cs_v4){INFINITY, INFINITY, INFINITY, 1});
}

celspan_status cs_regrid_row(cs_regrid_rows *rows, int plane, int32_t y, float (*nodes)[4],
                             bool *even) {
  int32_t groups = cs_defocused_groups(rows->to), columns = rows->to->columns;
  CS_TRY(mix_rows(rows, plane, y));
  for (int32_t g = 0; g < groups; g++) {
    int32_t x = g * CS_DEFOCUSED_GROUP, stop = x + CS_DEFOCUSED_GROUP;
    stop = stop < columns ? stop : columns;
    even[g] = stop <= rows->first || x >= rows->end;
    for (int32_t step = even[g] && stop - x > 1 ? stop - x - 1 : 1; x < stop; x += step)
      cs_v4_store(nodes[x], mix_column(rows, x));
  }
  return CELSPAN_OK;
}
