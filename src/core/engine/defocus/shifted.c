#include "engine/defocus/shifted.h"

#include <math.h>

#include "base/number.h"
#include "model/geometry/matrix.h"

#define TAPS 2048      /* at most */
#define SEGMENTS 16    /* pieces of a way whose lengths are added */
#define MOST (1 << 26) /* nodes of a grid that is read: 1 GiB a plane, if all of it is */

/* ---------------------------------------------------------------- taps */

/* From a point to one of the points that are shown there, in the cel's units. t: -1..1. */
static celspan_matrix way_at(const cs_shift *shift, double t) {
  const double extent = t * shift->extent;
  switch (shift->kind) {
  case CS_SHIFT_DISPLACED:
    break;
  case CS_SHIFT_LINE:
    return celspan_matrix_translation(t * shift->at.x, t * shift->at.y);
  case CS_SHIFT_ZOOM:
    return celspan_matrix_scaling_about(1 + extent, 1 + extent, shift->at);
  case CS_SHIFT_SPIN:
    return celspan_matrix_rotation(extent, shift->at);
  }
  return celspan_matrix_identity();
}

static celspan_matrix tap_at(const cs_shifted *map, double t) {
  const celspan_matrix way = way_at(map->shift, t);
  return celspan_matrix_then(celspan_matrix_then(map->to_units, way), map->to_nodes);
}

/* Where a matrix leaves a point; behind the horizon, at its edge. */
static celspan_point place_of(const celspan_matrix *matrix, double x, double y) {
  cs_hpoint p = cs_matrix_apply(matrix, (cs_hpoint){x, y, 1});
  double w = p.w > 1e-9 ? p.w : 1e-9;
  return (celspan_point){p.x / w, p.y / w};
}

/* The length of the way that is seen at a pixel, in nodes. */
static double way_length(const cs_shifted *map, double x, double y) {
  double length = 0;
  celspan_point last = {0, 0};
  for (int k = 0; k <= SEGMENTS; k++) {
    const celspan_matrix tap = tap_at(map, 2.0 * k / SEGMENTS - 1);
    celspan_point p = place_of(&tap, x, y);
    length += k > 0 ? cs_number_length(p.x - last.x, p.y - last.y) : 0;
    last = p;
  }
  return length;
}

/* About one tap for each node of the longest way: those at the corners. */
static size_t count_taps(const cs_shifted *map) {
  const cs_defocused_range *x = &map->columns, *y = &map->rows;
  double length = fmax(fmax(way_length(map, x->first, y->first), way_length(map, x->end, y->first)),
                       fmax(way_length(map, x->first, y->end), way_length(map, x->end, y->end)));
  return (size_t)cs_number_clamp(ceil(length), 1, TAPS);
}

static bool is_affine(const double m[9]) { return m[6] == 0 && m[7] == 0 && m[8] == 1; }

static celspan_status init_line(celspan_context *context, cs_shifted *map) {
  const double *m = map->to_nodes.m;
  const celspan_point to = map->shift->at;
  const double end[2] = {m[0] * to.x + m[1] * to.y, m[3] * to.x + m[4] * to.y};
  map->is_line = true;
  return cs_shifted_line_init(context, end, count_taps(map), &map->line);
}

celspan_status cs_shifted_init(celspan_context *context, cs_shift *shift, cs_shifted *map) {
  map->shift = cs_shift_ref(shift);
  map->is_affine = is_affine(map->to_units.m) && is_affine(map->to_nodes.m);
  if (shift->kind == CS_SHIFT_LINE && map->is_affine)
    return init_line(context, map);
  map->tap_count = shift->kind == CS_SHIFT_DISPLACED ? 1 : count_taps(map);
  CS_TRY(CS_MAKE(context, map->taps, map->tap_count));
  for (size_t k = 0; k < map->tap_count; k++)
    map->taps[k] = tap_at(map, (2 * (double)k + 1) / (double)map->tap_count - 1);
  return CELSPAN_OK;
}

void cs_shifted_finish(cs_shifted *map, cs_memory *memory) {
  cs_shift_unref((cs_shift *)map->shift);
  cs_shifted_line_finish(&map->line, memory);
  cs_mem_free(memory, map->taps, map->tap_count * sizeof *map->taps);
  *map = (cs_shifted){0};
}

/* ---------------------------------------------------------------- life */

celspan_status cs_shifted_refuse(celspan_context *context, double width, double height) {
  return cs_fail(context, CELSPAN_LIMIT,
                 "displace, blur: %.0f x %.0f pixels would be read for the frame, and %d are the "
                 "most, %d a side; a smaller scale, radius, object or frame needs fewer",
                 width, height, MOST, CS_SHIFTED_SIDE);
}

static int32_t count_columns(const cs_shifted *map) {
  return map->columns.end - map->columns.first;
}

static celspan_status begin_places(cs_shifted_rows *rows) {
  const cs_shifted *map = rows->map;
  size_t count = (size_t)count_columns(map);
  for (int axis = 0; axis < 2; axis++)
    CS_TRY(CS_MAKE(rows->context, rows->places[axis], count));
  return CELSPAN_OK;
}

celspan_status cs_shifted_begin(const cs_shifted *map, const cs_defocused *to,
                                celspan_context *context, cs_shifted_rows *out) {
  *out = (cs_shifted_rows){.map = map, .to = to, .context = context, .isa = cs_isa_best()};
  if ((int64_t)map->from->columns * map->from->rows > MOST)
    return cs_shifted_refuse(context, map->from->columns, map->from->rows);
  CS_TRY(cs_shifted_source_begin(context, map->from, &out->from));
  CS_TRY(cs_shifted_source_begin(context, map->by, &out->by));
  return map->is_line ? cs_shifted_line_begin(context, &map->line, &out->from,
                                              map->from_at[0] + map->columns.first,
                                              count_columns(map), &out->line)
                      : begin_places(out);
}

void cs_shifted_end(cs_shifted_rows *rows) {
  cs_memory *memory = rows->context->memory;
  size_t count = (size_t)count_columns(rows->map);
  CS_ARRAYS_FREE(memory, &rows->line, nodes, sums);
  cs_shifted_source_end(rows->context, &rows->from);
  cs_shifted_source_end(rows->context, &rows->by);
  for (int axis = 0; axis < 2; axis++)
    cs_mem_free(memory, rows->places[axis], count * sizeof *rows->places[axis]);
}

/* ---------------------------------------------------------------- places */

/* Clamps the places of a row to the nodes, and takes the rows that they are in. */
static celspan_status settle(cs_shifted_rows *rows) {
  const cs_defocused *grid = rows->map->from;
  const double last[2] = {grid->columns - 1, grid->rows - 1};
  double range[2];
  CS_WIDE_CHOOSE(rows->isa, cs_shifted_settle)
  (last, count_columns(rows->map), rows->places[0], rows->places[1], range);
  return cs_shifted_source_take(rows->context, &rows->from, range[0], range[1]);
}

static void read_places(const cs_shifted_rows *rows, int plane, bool adds, float (*out)[4]) {
  const cs_shifted_source *from = &rows->from;
  const cs_shifted_nodes nodes = {(const float *const *)from->rows, (size_t)plane * from->plane,
                                  from->grid->columns, from->grid->rows};
  CS_WIDE_CHOOSE(rows->isa, cs_shifted_read)
  (&nodes, rows->places[0], rows->places[1], count_columns(rows->map), adds, out[0]);
}

/* ---------------------------------------------------------------- displaced */

/* The columns of row y of the frame that `by` covers, and its nodes there; else nothing. */
static celspan_status read_by(cs_shifted_rows *rows, int32_t y, const float (**nodes)[4],
                              cs_defocused_range *out) {
  const cs_shifted *map = rows->map;
  const cs_defocused *by = map->by;
  int32_t row = y + map->by_at[1], left = map->by_at[0] + map->columns.first;
  *out = (cs_defocused_range){0, 0};
  if (!by || row < 0 || row >= by->rows)
    return CELSPAN_OK;
  int32_t first = (int32_t)cs_number_clamp(-(double)left, 0, count_columns(map));
  int32_t end = (int32_t)cs_number_clamp((double)by->columns - left, 0, count_columns(map));
  CS_TRY(cs_shifted_source_take(rows->context, &rows->by, row, row));
  if (first >= end)
    return CELSPAN_OK;
  *nodes = (const float(*)[4])(const void *)rows->by.rows[row] + (left + first);
  *out = (cs_defocused_range){first, end};
  return CELSPAN_OK;
}

/* How far the points of a row move, in the cel's units, as places. */
static celspan_status find_moves(cs_shifted_rows *rows, int32_t y) {
  const cs_shifted *map = rows->map;
  const cs_shift *shift = map->shift;
  const double clear = shift->moves_clear ? -shift->scale / 2 : 0;
  int32_t count = count_columns(map);
  const float(*nodes)[4] = NULL;
  cs_defocused_range there;
  CS_TRY(read_by(rows, y, &nodes, &there));
  for (int axis = 0; axis < 2; axis++) {
    double *moves = rows->places[axis];
    const cs_shifted_moving moving = {shift->channels[axis], shift->space != map->space,
                                      shift->space, shift->scale, clear};
    for (int32_t i = 0; i < there.first; i++)
      moves[i] = clear;
    CS_WIDE_CHOOSE(rows->isa, cs_shifted_moves)
    (&moving, nodes, there.end - there.first, moves + there.first);
    for (int32_t i = there.end; i < count; i++)
      moves[i] = clear;
  }
  return CELSPAN_OK;
}

/* From moves to places, of the centres of a row of pixels. */
static void move_places(cs_shifted_rows *rows, int32_t y) {
  const cs_shifted *map = rows->map;
  const double *tap = map->taps[0].m, *m = map->to_nodes.m;
  const double column = map->columns.first + 0.5, row = y + 0.5, step[2] = {tap[0], tap[3]},
               start[2] = {tap[0] * column + tap[1] * row + tap[2],
                           tap[3] * column + tap[4] * row + tap[5]},
               units[2][2] = {{m[0], m[1]}, {m[3], m[4]}};
  double *x = rows->places[0], *y_of = rows->places[1];
  int32_t count = count_columns(map);
  if (map->is_affine) {
    CS_WIDE_CHOOSE(rows->isa, cs_shifted_move)(start, step, units, count, x, y_of);
    return;
  }
  for (int32_t i = 0; i < count; i++) {
    celspan_point own = place_of(&map->to_units, column + i, row);
    celspan_point place = place_of(&map->to_nodes, own.x + x[i], own.y + y_of[i]);
    x[i] = place.x;
    y_of[i] = place.y;
  }
}

static celspan_status displace(cs_shifted_rows *rows, int plane, int32_t y, float (*out)[4]) {
  if (plane == 0) {
    CS_TRY(find_moves(rows, y));
    move_places(rows, y);
    CS_TRY(settle(rows));
  }
  read_places(rows, plane, false, out);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- along lines, rays and arcs */

static void place_tap(cs_shifted_rows *rows, const celspan_matrix *tap, int32_t y) {
  const double *m = tap->m, column = rows->map->columns.first + 0.5, row = y + 0.5;
  double *across = rows->places[0], *down = rows->places[1];
  int32_t count = count_columns(rows->map);
  if (is_affine(m)) {
    const double left = m[0] * column + m[1] * row + m[2], top = m[3] * column + m[4] * row + m[5];
    for (int32_t i = 0; i < count; i++) {
      across[i] = left + m[0] * i;
      down[i] = top + m[3] * i;
    }
    return;
  }
  for (int32_t i = 0; i < count; i++) {
    celspan_point p = place_of(tap, column + i, row);
    across[i] = p.x;
    down[i] = p.y;
  }
}

static celspan_status add_taps(cs_shifted_rows *rows, int plane, int32_t y, float (*out)[4]) {
  const cs_shifted *map = rows->map;
  size_t count = (size_t)count_columns(map);
  memset(out, 0, count * sizeof *out);
  for (size_t k = 0; k < map->tap_count; k++) {
    place_tap(rows, &map->taps[k], y);
    CS_TRY(settle(rows));
    read_places(rows, plane, true, out);
  }
  const float share = 1 / (float)map->tap_count;
  for (size_t i = 0; i < count; i++)
    cs_v4_store(out[i], share * cs_v4_load(out[i]));
  return CELSPAN_OK;
}

static celspan_status mean(cs_shifted_rows *rows, int plane, int32_t y, float (*out)[4]) {
  const cs_shifted *map = rows->map;
  const float *sums = out[0];
  CS_TRY(map->is_line ? cs_shifted_line_row(rows->context, rows->isa, &rows->line, plane,
                                            map->from_at[1] + y, &sums)
                      : add_taps(rows, plane, y, out));
  for (int32_t i = 0; i < count_columns(map); i++)
    cs_v4_store(out[i], cs_v4_settled(cs_v4_load(sums + 4 * (size_t)i)));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

/* Makes the nodes [first, end) clear. */
static void clear(int plane, int32_t first, int32_t end, float (*nodes)[4]) {
  const cs_v4 value = plane == 0 ? cs_v4_all(0) : (cs_v4){1, 1, 1, 0};
  for (int32_t i = first; i < end; i++)
    cs_v4_store(nodes[i], value);
}

celspan_status cs_shifted_row(cs_shifted_rows *rows, int plane, int32_t y, float (*nodes)[4]) {
  const cs_shifted *map = rows->map;
  int32_t row = y - 1, first = map->columns.first + 1, end = map->columns.end + 1;
  if (row < map->rows.first || row >= map->rows.end) {
    clear(plane, 0, rows->to->columns, nodes);
    return CELSPAN_OK;
  }
  if (plane == 0) {
    cs_shifted_source_next(rows->context, &rows->from);
    cs_shifted_source_next(rows->context, &rows->by);
  }
  clear(plane, 0, first, nodes);
  clear(plane, end, rows->to->columns, nodes);
  return map->shift->kind == CS_SHIFT_DISPLACED ? displace(rows, plane, row, nodes + first)
                                                : mean(rows, plane, row, nodes + first);
}
