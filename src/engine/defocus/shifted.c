#include "engine/defocus/shifted.h"

#include <math.h>

#include "base/number.h"
#include "model/colour/space.h"
#include "model/geometry/matrix.h"

#define TAPS 2048      /* at most */
#define SEGMENTS 16    /* of a way, to measure it */
#define MOST (1 << 26) /* nodes of a grid that is read: 1 GiB a plane, if all of it is */
#define GROUP CS_DEFOCUSED_GROUP

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

celspan_status cs_shifted_init(celspan_context *context, cs_shift *shift, cs_shifted *map) {
  map->shift = cs_shift_ref(shift);
  map->tap_count = shift->kind == CS_SHIFT_DISPLACED ? 1 : count_taps(map);
  CS_TRY(CS_MAKE(context, map->taps, map->tap_count));
  const double *units = map->to_units.m, *nodes = map->to_nodes.m;
  map->is_affine = is_affine(units) && is_affine(nodes);
  for (size_t k = 0; k < map->tap_count; k++)
    map->taps[k] = tap_at(map, (2 * (double)k + 1) / (double)map->tap_count - 1);
  return CELSPAN_OK;
}

void cs_shifted_finish(cs_shifted *map, cs_memory *memory) {
  cs_shift_unref((cs_shift *)map->shift);
  cs_mem_free(memory, map->taps, map->tap_count * sizeof *map->taps);
  *map = (cs_shifted){0};
}

/* ---------------------------------------------------------------- nodes that are read */

static celspan_status begin_source(celspan_context *context, const cs_defocused *grid,
                                   cs_shifted_source *out) {
  if (!grid)
    return CELSPAN_OK;
  out->grid = grid;
  out->band_count = (size_t)((grid->rows + grid->band_rows - 1) / grid->band_rows);
  return CS_MAKE(context, out->bands, out->band_count);
}

static void end_source(celspan_context *context, cs_shifted_source *source) {
  for (size_t k = 0; source->bands && k < source->band_count; k++)
    if (source->bands[k])
      source->grid->release(source->grid, context, source->bands[k]);
  cs_mem_free(context->memory, source->bands, source->band_count * sizeof *source->bands);
}

/* Acquires the bands of the rows from `low` to `high`, which may lie anywhere. */
static celspan_status acquire(celspan_context *context, cs_shifted_source *source, double low,
                              double high) {
  const cs_defocused *grid = source->grid;
  int32_t last = grid->rows - 1;
  /* read_at mixes two rows everywhere, at the borders, too */
  int32_t first = (int32_t)cs_number_clamp(floor(low), 0, last - 1) / grid->band_rows;
  int32_t end = (int32_t)cs_number_clamp(floor(high) + 1, 1, last) / grid->band_rows;
  for (int32_t k = first; k <= end; k++)
    if (!source->bands[k])
      CS_TRY(grid->acquire(grid, context, k, &source->bands[k]));
  return CELSPAN_OK;
}

static inline const float (*row_of(const cs_shifted_source *source, int plane, int32_t row))[4] {
  const cs_defocused *grid = source->grid;
  size_t at = (size_t)plane * (size_t)grid->band_rows + (size_t)(row % grid->band_rows);
  const cs_defocus_band *band = source->bands[row / grid->band_rows];
  return (const float(*)[4])band->nodes + at * (size_t)grid->columns;
}

/* The nodes at a place, mixed. Beyond the grid nothing differs from its border. */
static inline cs_v4 read_at(const cs_shifted_source *source, int plane, double x, double y) {
  const cs_defocused *grid = source->grid;
  x = cs_number_clamp(x, 0, grid->columns - 1);
  y = cs_number_clamp(y, 0, grid->rows - 1);
  int32_t i = (int32_t)x, j = (int32_t)y;
  i = i < grid->columns - 1 ? i : grid->columns - 2;
  j = j < grid->rows - 1 ? j : grid->rows - 2;
  float across = (float)(x - i), down = (float)(y - j);
  const float(*upper)[4] = row_of(source, plane, j) + i;
  const float(*lower)[4] = row_of(source, plane, j + 1) + i;
  cs_v4 a = cs_v4_load(upper[0]), b = cs_v4_load(lower[0]);
  a += across * (cs_v4_load(upper[1]) - a);
  b += across * (cs_v4_load(lower[1]) - b);
  return a + down * (b - a);
}

/* ---------------------------------------------------------------- life */

celspan_status cs_shifted_refuse(celspan_context *context, double width, double height) {
  return cs_fail(context, CELSPAN_LIMIT,
                 "displace, blur: %.0f x %.0f pixels would be read for the frame, and %d are the "
                 "most, %d a side; a smaller scale, radius, object or frame needs fewer",
                 width, height, MOST, CS_SHIFTED_SIDE);
}

celspan_status cs_shifted_begin(const cs_shifted *map, const cs_defocused *to,
                                celspan_context *context, cs_shifted_rows *out) {
  *out = (cs_shifted_rows){.map = map, .to = to, .context = context, .isa = cs_isa_best()};
  size_t count = (size_t)(map->columns.end - map->columns.first);
  if ((int64_t)map->from->columns * map->from->rows > MOST)
    return cs_shifted_refuse(context, map->from->columns, map->from->rows);
  CS_TRY(begin_source(context, map->from, &out->from));
  CS_TRY(begin_source(context, map->by, &out->by));
  if (map->shift->kind != CS_SHIFT_DISPLACED)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, out->places, count));
  return CS_MAKE(context, out->channels, 3 * count);
}

void cs_shifted_end(cs_shifted_rows *rows) {
  cs_memory *memory = rows->context->memory;
  size_t count = (size_t)(rows->map->columns.end - rows->map->columns.first);
  end_source(rows->context, &rows->from);
  end_source(rows->context, &rows->by);
  cs_mem_free(memory, rows->places, count * sizeof *rows->places);
  cs_mem_free(memory, rows->channels, 3 * count * sizeof *rows->channels);
}

/* ---------------------------------------------------------------- displaced */

/* One channel of what displaces, for all columns of a row, times its alpha. */
static void take_channel(const cs_shifted_rows *rows, const float (*nodes)[4], int32_t count,
                         int axis, float *out) {
  const cs_shift *shift = rows->map->shift;
  const celspan_channel channel = shift->channels[axis];
  for (int32_t i = 0; i < count; i++)
    out[i] = nodes[i][channel];
  if (channel == CELSPAN_CHANNEL_ALPHA)
    for (int32_t i = 0; i < count; i++)
      out[i] *= out[i];
  else if (shift->space != rows->map->space)
    CS_WIDE_CHOOSE(rows->isa, cs_space_channels)
  (shift->space, rows->channels + 2 * (size_t)count, count, out);
}

/* How far a point moves along an axis, in the cel's units. */
static inline double move_of(const cs_shift *shift, float channel, float alpha) {
  double share = (double)channel / (double)alpha;
  return shift->scale * (cs_number_clamp(share, 0, 1) - 0.5);
}

/* The place that is shown at the centre of a pixel, moved in the cel's units. */
static inline void move_place(const cs_shifted *map, double x, double y, celspan_point by,
                              double out[2]) {
  const celspan_matrix *tap = &map->taps[0];
  const double *m = map->to_nodes.m;
  celspan_point p;
  if (map->is_affine) {
    p = (celspan_point){tap->m[0] * x + tap->m[1] * y + tap->m[2] + m[0] * by.x + m[1] * by.y,
                        tap->m[3] * x + tap->m[4] * y + tap->m[5] + m[3] * by.x + m[4] * by.y};
  } else {
    celspan_point own = place_of(&map->to_units, x, y);
    p = place_of(&map->to_nodes, own.x + by.x, own.y + by.y);
  }
  out[0] = p.x;
  out[1] = p.y;
}

/* The nodes of `by` under [first, end) of the columns of a row; the others are clear. */
static celspan_status read_by(cs_shifted_rows *rows, int32_t y, const float (**nodes)[4],
                              cs_defocused_range *out) {
  const cs_shifted *map = rows->map;
  const cs_defocused *by = map->by;
  int32_t row = y + map->by_at[1], left = map->by_at[0] + map->columns.first;
  *out = (cs_defocused_range){0, 0};
  if (!by || row < 0 || row >= by->rows)
    return CELSPAN_OK;
  out->first = left < 0 ? -left : 0;
  out->end = (int32_t)cs_number_clamp(by->columns - left, 0, map->columns.end - map->columns.first);
  CS_TRY(acquire(rows->context, &rows->by, row, row));
  *nodes = row_of(&rows->by, 0, row) + left;
  return CELSPAN_OK;
}

/* Finds the places of a row, and the rows that they are in. */
static celspan_status find_places(cs_shifted_rows *rows, int32_t y) {
  const cs_shifted *map = rows->map;
  int32_t count = map->columns.end - map->columns.first;
  const float(*nodes)[4] = NULL;
  cs_defocused_range there;
  double low = INFINITY, high = -INFINITY;
  CS_TRY(read_by(rows, y, &nodes, &there));
  int32_t moved = there.end > there.first ? there.end - there.first : 0;
  float *alpha = rows->channels + 2 * (size_t)moved;
  for (int32_t i = 0; i < moved; i++)
    alpha[i] = nodes[there.first + i][3];
  for (int axis = 0; axis < 2 && moved > 0; axis++)
    take_channel(rows, nodes + there.first, moved, axis, rows->channels + axis * (size_t)moved);
  const double clear = map->shift->moves_clear ? map->shift->scale / 2 : 0;
  for (int32_t i = 0; i < count; i++) {
    int32_t k = i - there.first;
    celspan_point by = {-clear, -clear};
    if (k >= 0 && k < moved && alpha[k] > 0)
      by = (celspan_point){move_of(map->shift, rows->channels[k], alpha[k]),
                           move_of(map->shift, rows->channels[moved + k], alpha[k])};
    move_place(map, map->columns.first + i + 0.5, y + 0.5, by, rows->places[i]);
    low = fmin(low, rows->places[i][1]);
    high = fmax(high, rows->places[i][1]);
  }
  return acquire(rows->context, &rows->from, low, high);
}

static celspan_status displace(cs_shifted_rows *rows, int plane, int32_t y, float (*out)[4]) {
  int32_t count = rows->map->columns.end - rows->map->columns.first;
  if (plane == 0)
    CS_TRY(find_places(rows, y));
  for (int32_t i = 0; i < count; i++)
    cs_v4_store(out[i], read_at(&rows->from, plane, rows->places[i][0], rows->places[i][1]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- along lines, rays and arcs */

/* Whether a tap is the same step from every pixel. */
static bool is_step(const celspan_matrix *tap) {
  const double *m = tap->m;
  return is_affine(m) && fabs(m[0] - 1) < 1e-9 && fabs(m[1]) < 1e-9 && fabs(m[3]) < 1e-9 &&
         fabs(m[4] - 1) < 1e-9;
}

/* Adds a tap whose step is the same for all columns: they read neighbouring nodes of two rows. */
static celspan_status add_step(cs_shifted_rows *rows, const celspan_matrix *tap, int plane,
                               int32_t y, float (*sums)[4]) {
  const cs_shifted *map = rows->map;
  const cs_defocused *grid = map->from;
  int32_t count = map->columns.end - map->columns.first;
  double across = map->columns.first + 0.5 + tap->m[2];
  double down = cs_number_clamp(y + 0.5 + tap->m[5], 0, grid->rows - 1);
  int32_t j = (int32_t)down < grid->rows - 1 ? (int32_t)down : grid->rows - 2;
  across = cs_number_clamp(across, -0x1p30, 0x1p30);
  int32_t left = cs_number_floor(across);
  const float shares[2] = {(float)(across - left), (float)(down - j)};
  int32_t first = (int32_t)cs_number_clamp(-(double)left, 0, count);
  int32_t end = (int32_t)cs_number_clamp((double)grid->columns - 1 - left, first, count);
  CS_TRY(acquire(rows->context, &rows->from, down, down));
  const float(*upper)[4] = row_of(&rows->from, plane, j), (*lower)[4];
  lower = row_of(&rows->from, plane, j + 1);
  const cs_v4 before = cs_v4_load(upper[0]), after = cs_v4_load(upper[grid->columns - 1]);
  for (int32_t i = 0; i < first; i++)
    cs_v4_store(sums[i], cs_v4_load(sums[i]) + before);
  if (end > first)
    CS_WIDE_CHOOSE(rows->isa, cs_shifted_add)
  (upper[left + first], lower[left + first], shares, end - first, sums[first]);
  for (int32_t i = end; i < count; i++)
    cs_v4_store(sums[i], cs_v4_load(sums[i]) + after);
  return CELSPAN_OK;
}

typedef struct tap_rows {
  double low, high;
} tap_rows;

/* The least and the greatest y that a tap reads in a row. Without perspective its places lie on a
 * line; else some may be near the horizon, beyond all others. */
static tap_rows rows_of_tap(const celspan_matrix *tap, double first, int32_t count, double y) {
  tap_rows found = {INFINITY, -INFINITY};
  int32_t step = is_affine(tap->m) && count > 1 ? count - 1 : 1;
  for (int32_t i = 0; i < count; i += step) {
    celspan_point p = place_of(tap, first + i, y);
    found.low = fmin(found.low, p.y);
    found.high = fmax(found.high, p.y);
  }
  return found;
}

/* Adds any other tap. */
static celspan_status add_tap(cs_shifted_rows *rows, const celspan_matrix *tap, int plane,
                              int32_t y, float (*sums)[4]) {
  const cs_shifted *map = rows->map;
  const double first = map->columns.first + 0.5;
  int32_t count = map->columns.end - map->columns.first;
  const tap_rows seen = rows_of_tap(tap, first, count, y + 0.5);
  CS_TRY(acquire(rows->context, &rows->from, seen.low, seen.high));
  for (int32_t i = 0; i < count; i++) {
    celspan_point p = place_of(tap, first + i, y + 0.5);
    /* between the ends of a line, rounding may exceed both */
    double down = cs_number_clamp(p.y, seen.low, seen.high);
    cs_v4_store(sums[i], cs_v4_load(sums[i]) + read_at(&rows->from, plane, p.x, down));
  }
  return CELSPAN_OK;
}

static celspan_status mean(cs_shifted_rows *rows, int plane, int32_t y, float (*out)[4]) {
  const cs_shifted *map = rows->map;
  size_t count = (size_t)(map->columns.end - map->columns.first);
  memset(out, 0, count * sizeof *out);
  for (size_t k = 0; k < map->tap_count; k++)
    CS_TRY(is_step(&map->taps[k]) ? add_step(rows, &map->taps[k], plane, y, out)
                                  : add_tap(rows, &map->taps[k], plane, y, out));
  const float share = 1 / (float)map->tap_count;
  for (size_t i = 0; i < count; i++)
    cs_v4_store(out[i], cs_v4_settled(share * cs_v4_load(out[i])));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

/* Makes the nodes [first, end) clear, and the groups that lie in it even. */
static void clear(const cs_defocused *to, int plane, int32_t first, int32_t end, float (*nodes)[4],
                  bool *even) {
  const cs_v4 value = plane == 0 ? cs_v4_all(0) : (cs_v4){1, 1, 1, 0};
  for (int32_t i = first; i < end; i++)
    cs_v4_store(nodes[i], value);
  for (int32_t g = (first + GROUP - 1) / GROUP; g < cs_defocused_groups(to); g++) {
    int32_t last = (g + 1) * GROUP < to->columns ? (g + 1) * GROUP : to->columns;
    if (last <= end)
      even[g] = true;
  }
}

celspan_status cs_shifted_row(cs_shifted_rows *rows, int plane, int32_t y, float (*nodes)[4],
                              bool *even) {
  const cs_shifted *map = rows->map;
  const cs_defocused *to = rows->to;
  int32_t row = y - 1, first = map->columns.first + 1, end = map->columns.end + 1;
  memset(even, 0, (size_t)cs_defocused_groups(to) * sizeof *even);
  if (row < map->rows.first || row >= map->rows.end) {
    clear(to, plane, 0, to->columns, nodes, even);
    return CELSPAN_OK;
  }
  clear(to, plane, 0, first, nodes, even);
  clear(to, plane, end, to->columns, nodes, even);
  return map->shift->kind == CS_SHIFT_DISPLACED ? displace(rows, plane, row, nodes + first)
                                                : mean(rows, plane, row, nodes + first);
}
