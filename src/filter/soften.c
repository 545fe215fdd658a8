#include "filter/soften.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>

/* Cells in a radius: between nodes a Gaussian then bends by less than 1/2046 (its second derivative
 * is at most 0.242/sigma^2), and the kinks that even shapes leave by less than that of an edge. */
#define FINE_GAUSSIAN 16
#define FINE_EVEN 64
#define SUMMED 3 /* cells; a Gaussian of a radius from here on is summed over cells */
/* The same, where layers vary: boundaries know nothing of what lies between them. */
#define SUMMED_VARYING 1.5
#define SLICED 0.4 /* cells; likewise for even kernels */
#define BAND_BYTES (16 << 20)
#define BAND_ROWS 64
#define BAND_ROWS_LEAST 8
#define TILE 128 /* columns summed at a time */

/* ---------------------------------------------------------------- the grid */

/* The reach of a softness along an axis, radii for Gaussian and disc. */
static double radius_along(const cs_softness *softness, int axis) {
  return softness->kind != CELSPAN_DEFOCUS_BOX
             ? (axis == 0 ? softness->radius_x : softness->radius_y)
             : fabs(softness->edges[0][axis]) + fabs(softness->edges[1][axis]);
}

static double choose_pitch(const cs_softness *softness, int axis) {
  bool is_gaussian = softness->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  return fmax(1, radius_along(softness, axis) / (is_gaussian ? FINE_GAUSSIAN : FINE_EVEN));
}

static void scale_softness(cs_softness *softness, double pitch_x, double pitch_y) {
  softness->radius_x /= pitch_x;
  softness->radius_y /= pitch_y;
  for (int k = 0; k < 2; k++) {
    softness->edges[k][0] /= pitch_x;
    softness->edges[k][1] /= pitch_y;
  }
}

/* Weights by distance of a Gaussian over cells that are spread by `spread` (a variance) already. */
static celspan_status fill_weights(celspan_context *context, double radius, double blur,
                                   double spread, int32_t *reach, float **out) {
  double variance = 0.25 * radius * radius + blur * blur / 12 - spread, sum = 0;
  *reach = cs_number_ceil(2 * radius);
  float *weights = cs_mem_array(context->memory, (size_t)*reach + 1, sizeof *weights);
  if (!weights)
    return cs_fail_memory(context);
  for (int32_t k = *reach; k >= 0; k--)
    sum += (k > 0 ? 2 : 1) * cs_elementary_exp(-0.5 * k * k / variance);
  for (int32_t k = 0; k <= *reach; k++)
    weights[k] = (float)(cs_elementary_exp(-0.5 * k * k / variance) / sum);
  *out = weights;
  return CELSPAN_OK;
}

static celspan_status acquire(const cs_soft *soft, celspan_context *context, int32_t number,
                              cs_soft_band **out);
static void release(const cs_soft *soft, celspan_context *context, cs_soft_band *band) {
  (void)soft;
  cs_soft_bands_release(context, band);
}

celspan_status cs_soften_create(celspan_context *context, const cs_softness *softness, bool varies,
                                int32_t width, int32_t height, cs_soften **out) {
  CS_TRY(cs_soft_bands_ready(context));
  cs_soften *soften = cs_mem_array(context->memory, 1, sizeof *soften);
  if (!soften)
    return cs_fail_memory(context);
  cs_soft *soft = &soften->soft;
  soft->pitch_x = choose_pitch(softness, 0);
  soft->pitch_y = choose_pitch(softness, 1);
  soft->columns = cs_number_ceil(width / soft->pitch_x) + 2;
  soft->rows = cs_number_ceil(height / soft->pitch_y) + 2;
  soft->acquire = acquire;
  soft->release = release;
  int64_t rows = BAND_BYTES / ((int64_t)soft->columns * 4 * (int64_t)sizeof(float));
  soft->band_rows = (int32_t)cs_number_clamp((double)rows, BAND_ROWS_LEAST, BAND_ROWS);
  soften->softness = *softness;
  cs_softness *s = &soften->softness;
  scale_softness(s, soft->pitch_x, soft->pitch_y);
  double least = fmin(s->radius_x, s->radius_y);
  bool is_gaussian = s->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  soften->is_summed = is_gaussian && least >= (varies ? SUMMED_VARYING : SUMMED);
  soften->is_sliced = !is_gaussian && varies && least >= SLICED;
  celspan_status status = CELSPAN_OK;
  soften->has_tents = soften->is_summed && (soft->pitch_x == 1 || soft->pitch_y == 1);
  double spread = soften->has_tents ? 1.0 / 6 : 1.0 / 12;
  if (soften->is_summed)
    status =
        fill_weights(context, s->radius_x, s->blur, spread, &soften->reach_x, &soften->weights[0]);
  if (soften->is_summed && status == CELSPAN_OK)
    status =
        fill_weights(context, s->radius_y, s->blur, spread, &soften->reach_y, &soften->weights[1]);
  if (soften->is_sliced && status == CELSPAN_OK)
    status = cs_soft_slices_init(context, s, &soften->slices);
  if (status == CELSPAN_OK)
    *out = soften;
  else
    cs_soften_free(soften, context->memory);
  return status;
}

void cs_soften_raster(const cs_soften *soften, int32_t *width, int32_t *height) {
  int32_t factor = soften->is_sliced ? soften->slices.factor : 1;
  *width = factor * soften->soft.columns + 2 * (soften->reach_x + soften->slices.reach_x);
  *height = factor * soften->soft.rows + 2 * (soften->reach_y + soften->slices.reach_y);
}

celspan_matrix cs_soften_matrix(const cs_soften *soften) {
  double factor = soften->is_sliced ? soften->slices.factor : 1;
  return celspan_matrix_then(
      celspan_matrix_scaling(factor / soften->soft.pitch_x, factor / soften->soft.pitch_y),
      celspan_matrix_translation(factor + soften->reach_x + soften->slices.reach_x,
                                 factor + soften->reach_y + soften->slices.reach_y));
}

celspan_status cs_soften_kernel(celspan_context *context, const cs_soften *soften,
                                cs_kernel **out) {
  static const cs_softness tent = {
      CELSPAN_DEFOCUS_BOX, 0.5, 0.5, {{0.5, 0}, {0, 0.5}}, 1}; /* a cell over a cell */
  *out = NULL;
  if (soften->is_sliced || (soften->is_summed && !soften->has_tents))
    return CELSPAN_OK;
  return cs_kernel_create_soft(context, soften->is_summed ? &tent : &soften->softness, out);
}

void cs_soften_free(cs_soften *soften, cs_memory *memory) {
  for (int axis = 0; axis < 2; axis++) {
    size_t reach = (size_t)(axis == 0 ? soften->reach_x : soften->reach_y);
    cs_mem_free(memory, soften->weights[axis], (reach + 1) * sizeof(float));
  }
  cs_soft_slices_finish(&soften->slices, memory);
  cs_mem_free(memory, soften, sizeof *soften);
}

/* ---------------------------------------------------------------- rows through a kernel */

static void write_row(const cs_row *row, float (*nodes)[4]) {
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, nodes[x]);
}

static celspan_status fill_filtered(const cs_soften *soften, cs_scan *scan, int32_t first,
                                    int32_t end, float (*nodes)[4]) {
  cs_row row;
  cs_row_init(&row);
  celspan_status status = CELSPAN_OK;
  for (int32_t y = first; y < end && status == CELSPAN_OK; y++) {
    status = cs_scan_row(scan, y, &row);
    if (status == CELSPAN_OK)
      write_row(&row, nodes + (size_t)(y - first) * (size_t)soften->soft.columns);
  }
  cs_row_finish(&row, scan->context->memory);
  return status;
}

/* ---------------------------------------------------------------- sums over cells */

/* Rows of cells under a band, and a tile of it. */
typedef struct summing {
  const cs_soften *soften;
  cs_row *rows; /* of cells: those of the band and `reach_y` more above and below */
  size_t *from; /* by row: the first span that may meet the tile */
  int32_t row_count, band_rows;
  int32_t x0, x1; /* nodes of the tile */
  cs_v4 *cells;   /* of one row: TILE + 2 reach_x */
  cs_v4 *across;  /* summed along the rows: TILE a row */
} summing;

/* The one colour of a row's cells under the tile; false when there are more. */
static bool one_colour(summing *s, int32_t k, cs_v4 *out) {
  const cs_row *row = &s->rows[k];
  size_t i = s->from[k];
  while (row->spans[i].x1 <= s->x0)
    i++;
  s->from[k] = i;
  *out = cs_v4_load(row->spans[i].colour);
  return row->spans[i].kind == CELSPAN_SPAN_SINGLE &&
         row->spans[i].x1 >= s->x1 + 2 * s->soften->reach_x;
}

static void spread_cells(summing *s, int32_t k) {
  const cs_row *row = &s->rows[k];
  int32_t end = s->x1 + 2 * s->soften->reach_x;
  for (size_t i = s->from[k]; i < row->count && row->spans[i].x0 < end; i++) {
    const celspan_span *span = &row->spans[i];
    int32_t x = span->x0 > s->x0 ? span->x0 : s->x0, stop = span->x1 < end ? span->x1 : end;
    for (; x < stop; x++) {
      float rgba[4];
      celspan_span_colour(span, x, rgba);
      s->cells[x - s->x0] = cs_v4_load(rgba);
    }
  }
}

/* The sum about value 0 of a line of values `stride` apart: differences from it, so that equal
 * values stay what they are. */
static inline cs_v4 sum_about(const cs_v4 *value, size_t stride, const float *weights,
                              int32_t reach) {
  cs_v4 centre = *value, sum = cs_v4_all(0);
  for (int32_t k = reach; k >= 1; k--) {
    size_t away = (size_t)k * stride;
    sum += weights[k] * ((value[away] - centre) + (*(value - away) - centre));
  }
  return centre + sum;
}

static void sum_across(summing *s, int32_t k) {
  const cs_soften *soften = s->soften;
  cs_v4 colour, *out = s->across + (size_t)k * TILE;
  int32_t width = s->x1 - s->x0;
  if (one_colour(s, k, &colour)) {
    for (int32_t x = 0; x < width; x++)
      out[x] = colour;
    return;
  }
  spread_cells(s, k);
  for (int32_t x = 0; x < width; x++)
    out[x] = sum_about(s->cells + soften->reach_x + x, 1, soften->weights[0], soften->reach_x);
}

/* Whether all rows are one colour under the tile. */
static bool is_plain(summing *s, cs_v4 *colour) {
  bool plain = one_colour(s, 0, colour);
  for (int32_t k = 1; k < s->row_count; k++) {
    cs_v4 other;
    plain = one_colour(s, k, &other) && plain && cs_v4_same(other, *colour);
  }
  return plain;
}

static void sum_tile(summing *s, float (*nodes)[4]) {
  const cs_soften *soften = s->soften;
  size_t columns = (size_t)soften->soft.columns;
  cs_v4 colour;
  bool plain = is_plain(s, &colour);
  for (int32_t k = 0; k < s->row_count && !plain; k++)
    sum_across(s, k);
  for (int32_t y = 0; y < s->band_rows; y++)
    for (int32_t x = s->x0; x < s->x1; x++) {
      const cs_v4 *centre = s->across + (size_t)(y + soften->reach_y) * TILE + (x - s->x0);
      cs_v4 value = plain ? colour : sum_about(centre, TILE, soften->weights[1], soften->reach_y);
      cs_v4_store(nodes[(size_t)y * columns + (size_t)x], value);
    }
}

static celspan_status sum_rows(summing *s, cs_scan *scan, int32_t first, float (*nodes)[4]) {
  int32_t columns = s->soften->soft.columns;
  for (int32_t k = 0; k < s->row_count; k++)
    CS_TRY(cs_scan_row(scan, first + k, &s->rows[k]));
  for (s->x0 = 0; s->x0 < columns; s->x0 = s->x1) {
    s->x1 = columns - s->x0 < TILE ? columns : s->x0 + TILE;
    sum_tile(s, nodes);
  }
  return CELSPAN_OK;
}

static celspan_status fill_summed(const cs_soften *soften, cs_scan *scan, int32_t first,
                                  int32_t end, float (*nodes)[4]) {
  cs_memory *memory = scan->context->memory;
  summing s = {.soften = soften, .band_rows = end - first};
  s.row_count = s.band_rows + 2 * soften->reach_y;
  size_t rows = (size_t)s.row_count, cells = TILE + 2 * (size_t)soften->reach_x;
  s.rows = cs_mem_array(memory, rows, sizeof *s.rows);
  s.from = cs_mem_array(memory, rows, sizeof *s.from);
  s.cells = cs_mem_array(memory, cells, sizeof *s.cells);
  s.across = cs_mem_array(memory, rows * TILE, sizeof *s.across);
  celspan_status status = s.rows && s.from && s.cells && s.across ? sum_rows(&s, scan, first, nodes)
                                                                  : cs_fail_memory(scan->context);
  for (size_t k = 0; s.rows && k < rows; k++)
    cs_row_finish(&s.rows[k], memory);
  cs_mem_free(memory, s.rows, rows * sizeof *s.rows);
  cs_mem_free(memory, s.from, rows * sizeof *s.from);
  cs_mem_free(memory, s.cells, cells * sizeof *s.cells);
  cs_mem_free(memory, s.across, rows * TILE * sizeof *s.across);
  return status;
}

/* ---------------------------------------------------------------- bands */

static celspan_status fill_plane(const cs_soften *soften, celspan_context *context, int plane,
                                 int32_t first, int32_t end, float (*nodes)[4]) {
  cs_scan scan;
  celspan_status status = cs_scan_init(&scan, context, &soften->shots[plane]);
  if (status == CELSPAN_OK && soften->is_sliced)
    status = cs_soft_slices_fill(&soften->slices, &scan, soften->soft.columns, first, end, nodes);
  else if (status == CELSPAN_OK)
    status = soften->is_summed ? fill_summed(soften, &scan, first, end, nodes)
                               : fill_filtered(soften, &scan, first, end, nodes);
  cs_scan_finish(&scan);
  return status;
}

static celspan_status make_band(const void *layer, celspan_context *context, int32_t number,
                                float (*nodes)[4]) {
  const cs_soften *soften = layer;
  const cs_soft *soft = &soften->soft;
  int32_t first = number * soft->band_rows;
  int32_t end = soft->rows - first < soft->band_rows ? soft->rows : first + soft->band_rows;
  size_t plane_size = (size_t)soft->band_rows * (size_t)soft->columns;
  for (int plane = 0; plane < soft->planes; plane++)
    CS_TRY(fill_plane(soften, context, plane, first, end, nodes + (size_t)plane * plane_size));
  return CELSPAN_OK;
}

static celspan_status acquire(const cs_soft *soft, celspan_context *context, int32_t number,
                              cs_soft_band **out) {
  const cs_soften *soften = (const cs_soften *)soft;
  cs_band_key key = {soften->key, number};
  size_t size =
      (size_t)soft->planes * (size_t)soft->band_rows * (size_t)soft->columns * 4 * sizeof(float);
  return cs_soft_bands_acquire(context, &key, size, make_band, soften, out);
}
