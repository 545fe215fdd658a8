#include "filter/soften.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>

/* Cells in a radius: between nodes a Gaussian then bends by less than 1/2046 (its second derivative
 * is at most 0.242/sigma^2), the rim of a disc leaves less than 0.9/1023, and the kinks of a box
 * less than those of an edge. */
#define FINE_GAUSSIAN 16
#define FINE_DISC 28
#define FINE_BOX 64
/* Radii in cells from which on flat art is weighed line by line: a box when its kinks allow. */
#define EDGES_GAUSSIAN 3
#define EDGES_BOX 40
#define BAND_BYTES (16 << 20)
#define BAND_ROWS 128
#define BAND_ROWS_LEAST 8

/* ---------------------------------------------------------------- the grid */

/* The reach of a softness along an axis, radii for Gaussian and disc. */
static double radius_along(const cs_softness *softness, int axis) {
  return softness->kind != CELSPAN_DEFOCUS_BOX
             ? (axis == 0 ? softness->radius_x : softness->radius_y)
             : fabs(softness->edges[0][axis]) + fabs(softness->edges[1][axis]);
}

static double choose_pitch(const cs_softness *softness, int axis) {
  double fine = softness->kind == CELSPAN_DEFOCUS_GAUSSIAN ? FINE_GAUSSIAN
                : softness->kind == CELSPAN_DEFOCUS_DISC   ? FINE_DISC
                                                           : FINE_BOX;
  return fmax(1, radius_along(softness, axis) / fine);
}

static void scale_softness(cs_softness *softness, double pitch_x, double pitch_y) {
  softness->radius_x /= pitch_x;
  softness->radius_y /= pitch_y;
  for (int k = 0; k < 2; k++) {
    softness->edges[k][0] /= pitch_x;
    softness->edges[k][1] /= pitch_y;
  }
}

static celspan_status acquire(const cs_soft *soft, celspan_context *context, int32_t number,
                              cs_soft_band **out);
static void release(const cs_soft *soft, celspan_context *context, cs_soft_band *band) {
  (void)soft;
  cs_soft_bands_release(context, band);
}

/* Boundaries know nothing of what lies between them: where that varies, cells are taken. */
static cs_soften_way choose_way(const cs_softness *softness, bool varies) {
  bool is_gaussian = softness->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  if (varies)
    return is_gaussian ? CS_SOFTEN_SUMS : CS_SOFTEN_SLICES;
  double least = fmin(radius_along(softness, 0), radius_along(softness, 1));
  bool has_lines = is_gaussian ? least >= EDGES_GAUSSIAN
                               : softness->kind == CELSPAN_DEFOCUS_BOX &&
                                     cs_softness_is_upright(softness) && least >= EDGES_BOX;
  return has_lines ? CS_SOFTEN_EDGES : CS_SOFTEN_KERNEL;
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
  soften->way = choose_way(s, varies);
  celspan_status status = CELSPAN_OK;
  if (soften->way == CS_SOFTEN_EDGES)
    status = cs_soft_edges_init(context, s, &soften->edges);
  else if (soften->way == CS_SOFTEN_SUMS)
    status = cs_soft_sums_init(context, s->radius_x, s->radius_y, &soften->sums);
  else if (soften->way == CS_SOFTEN_SLICES)
    status = cs_soft_slices_init(context, s, &soften->slices);
  if (status == CELSPAN_OK)
    *out = soften;
  else
    cs_soften_free(soften, context->memory);
  return status;
}

/* Pixels of the shots in a node's width, and beyond the nodes' own on each side. */
static int32_t find_reach(const cs_soften *soften, int32_t *x, int32_t *y) {
  *x = soften->edges.reach_x + soften->sums.reach_x + soften->slices.reach_x;
  *y = soften->edges.reach_y + soften->sums.reach_y + soften->slices.reach_y;
  return soften->way == CS_SOFTEN_SUMS     ? soften->sums.factor
         : soften->way == CS_SOFTEN_SLICES ? soften->slices.factor
                                           : 1;
}

void cs_soften_raster(const cs_soften *soften, int32_t *width, int32_t *height) {
  int32_t reach_x, reach_y, factor = find_reach(soften, &reach_x, &reach_y);
  *width = factor * soften->soft.columns + 2 * reach_x;
  *height = factor * soften->soft.rows + 2 * reach_y;
}

celspan_matrix cs_soften_matrix(const cs_soften *soften) {
  int32_t reach_x, reach_y, factor = find_reach(soften, &reach_x, &reach_y);
  return celspan_matrix_then(
      celspan_matrix_scaling(factor / soften->soft.pitch_x, factor / soften->soft.pitch_y),
      celspan_matrix_translation(factor + reach_x, factor + reach_y));
}

/* Through what boundaries are seen in cells: a square as wide as the blur, which pictures do not
 * know, or as a cell, over a cell. *out: NULL where the means of cells will do. */
static celspan_status cell_kernel(celspan_context *context, const cs_soften *soften,
                                  cs_kernel **out) {
  int32_t reach_x, reach_y, factor = find_reach(soften, &reach_x, &reach_y);
  double blur = soften->softness.blur * factor;
  double x = fmax(1, blur / soften->soft.pitch_x), y = fmax(1, blur / soften->soft.pitch_y);
  bool is_fine = soften->soft.pitch_x > 1 && soften->soft.pitch_y > 1;
  const cs_softness square = {
      CELSPAN_DEFOCUS_BOX, 0.5 * x, 0.5 * y, {{0.5 * x, 0}, {0, 0.5 * y}}, 1};
  if (is_fine || (soften->way == CS_SOFTEN_SLICES && blur == 0))
    return CELSPAN_OK;
  return cs_kernel_create_soft(context, &square, out);
}

celspan_status cs_soften_kernel(celspan_context *context, const cs_soften *soften,
                                cs_kernel **out) {
  *out = NULL;
  switch (soften->way) {
  case CS_SOFTEN_EDGES:
    return CELSPAN_OK;
  case CS_SOFTEN_SUMS:
  case CS_SOFTEN_SLICES:
    return cell_kernel(context, soften, out);
  case CS_SOFTEN_KERNEL:
    return cs_kernel_create_soft(context, &soften->softness, out);
  }
  return CELSPAN_OK;
}

void cs_soften_free(cs_soften *soften, cs_memory *memory) {
  cs_soft_edges_finish(&soften->edges, memory);
  cs_soft_sums_finish(&soften->sums, memory);
  cs_soft_slices_finish(&soften->slices, memory);
  cs_mem_free(memory, soften, sizeof *soften);
}

/* ---------------------------------------------------------------- rows through a kernel */

static void write_row(const cs_row *row, float (*nodes)[4]) {
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, nodes[x]);
}

static celspan_status fill_filtered(cs_scan *scan, int32_t columns, int32_t first, int32_t end,
                                    float (*nodes)[4]) {
  cs_row row;
  cs_row_init(&row);
  celspan_status status = CELSPAN_OK;
  for (int32_t y = first; y < end && status == CELSPAN_OK; y++) {
    status = cs_scan_row(scan, y, &row);
    if (status == CELSPAN_OK)
      write_row(&row, nodes + (size_t)(y - first) * (size_t)columns);
  }
  cs_row_finish(&row, scan->context->memory);
  return status;
}

/* ---------------------------------------------------------------- bands */

static celspan_status fill_rows(const cs_soften *soften, cs_scan *scan, int32_t first, int32_t end,
                                float (*nodes)[4]) {
  int32_t columns = soften->soft.columns;
  switch (soften->way) {
  case CS_SOFTEN_KERNEL:
    return fill_filtered(scan, columns, first, end, nodes);
  case CS_SOFTEN_EDGES:
    return cs_soft_edges_fill(&soften->edges, scan, columns, first, end, nodes);
  case CS_SOFTEN_SUMS:
    return cs_soft_sums_fill(&soften->sums, scan, columns, first, end, nodes);
  case CS_SOFTEN_SLICES:
    return cs_soft_slices_fill(&soften->slices, scan, columns, first, end, nodes);
  }
  return CELSPAN_OK;
}

/* Rows filled at a time: cells of pictures take much room, so no more are held than make up for
 * those that are made twice. */
static int32_t rows_together(const cs_soften *soften) {
  int32_t reach_x, reach_y, factor = find_reach(soften, &reach_x, &reach_y);
  bool has_cells = soften->way == CS_SOFTEN_SUMS || soften->way == CS_SOFTEN_SLICES;
  int32_t rows = 4 * reach_y / factor;
  return !has_cells || rows > soften->soft.band_rows ? soften->soft.band_rows
         : rows < BAND_ROWS_LEAST                    ? BAND_ROWS_LEAST
                                                     : rows;
}

static celspan_status fill_plane(const cs_soften *soften, celspan_context *context, int plane,
                                 int32_t first, int32_t end, float (*nodes)[4]) {
  cs_scan scan;
  celspan_status status = cs_scan_init(&scan, context, &soften->shots[plane]);
  int32_t columns = soften->soft.columns, step = rows_together(soften);
  for (int32_t y = first; y < end && status == CELSPAN_OK; y += step)
    status = fill_rows(soften, &scan, y, end - y < step ? end : y + step,
                       nodes + (size_t)(y - first) * (size_t)columns);
  cs_scan_finish(&scan);
  return status;
}

/* Rows that are not blended with others are kept as knots, unless pictures leave none straight. */
static bool is_thin(const cs_soften *soften) {
  return soften->soft.pitch_y == 1 &&
         (soften->way == CS_SOFTEN_EDGES || soften->way == CS_SOFTEN_KERNEL);
}

static celspan_status make_band(const void *layer, celspan_context *context, int32_t number,
                                cs_soft_band *band) {
  const cs_soften *soften = layer;
  const cs_soft *soft = &soften->soft;
  int32_t first = number * soft->band_rows;
  int32_t end = soft->rows - first < soft->band_rows ? soft->rows : first + soft->band_rows;
  size_t plane_size = (size_t)soft->band_rows * (size_t)soft->columns;
  size_t count = (size_t)soft->planes * plane_size;
  band->nodes = cs_mem_resize(context->memory, NULL, 0, count * sizeof *band->nodes);
  if (!band->nodes)
    return cs_fail_memory(context);
  band->node_count = count;
  for (int plane = 0; plane < soft->planes; plane++)
    CS_TRY(
        fill_plane(soften, context, plane, first, end, band->nodes + (size_t)plane * plane_size));
  return is_thin(soften) ? cs_soft_band_thin(soft, context, end - first, band) : CELSPAN_OK;
}

static celspan_status acquire(const cs_soft *soft, celspan_context *context, int32_t number,
                              cs_soft_band **out) {
  const cs_soften *soften = (const cs_soften *)soft;
  cs_band_key key = {soften->key, number};
  return cs_soft_bands_acquire(context, &key, make_band, soften, out);
}
