#include "engine/defocus/defocus.h"

#include <math.h>

#include "base/number.h"
#include "engine/row/row.h"
#include "engine/sample/defocused.h"

/* ---------------------------------------------------------------- the cel */

/* Nodes in a radius. Between two nodes a Gaussian then deviates from a line by less than 1/2046
 * (its second derivative is at most 0.242/sigma^2), the rim of a disc by less than 0.9/1023, and
 * the kinks of a box by less than the kinks of an edge. */
#define FINE_GAUSSIAN 16
#define FINE_DISC 28
#define FINE_BOX 64
/* The least radii, in nodes, at which flat art is blurred line by line; a box is then wide enough
 * for its kinks. */
#define EDGES_GAUSSIAN 3
#define EDGES_BOX 40
#define BAND_BYTES (16 << 20)
#define BAND_ROWS 128
#define BAND_ROWS_OWN 64 /* bands of a grid of its own begin and end at any height of the frame */

/* ---------------------------------------------------------------- the grid */

double cs_defocus_radius(const cs_blur *blur, int axis) {
  return blur->kind != CELSPAN_DEFOCUS_BOX
             ? (axis == 0 ? blur->radius_x : blur->radius_y)
             : fabs(blur->edges[0][axis]) + fabs(blur->edges[1][axis]);
}

double cs_defocus_extent(const cs_blur *blur, int axis) {
  return (blur->kind == CELSPAN_DEFOCUS_GAUSSIAN ? 2 : 1) * cs_defocus_radius(blur, axis);
}

static double choose_pitch(const cs_blur *blur, int axis) {
  if (blur->kind == CELSPAN_DEFOCUS_PIXEL)
    return fmax(1, blur->steps[axis]);
  double fine = blur->kind == CELSPAN_DEFOCUS_GAUSSIAN ? FINE_GAUSSIAN
                : blur->kind == CELSPAN_DEFOCUS_DISC   ? FINE_DISC
                                                       : FINE_BOX;
  return fmax(1, cs_defocus_radius(blur, axis) / fine);
}

static void scale_blur(cs_blur *blur, double pitch_x, double pitch_y) {
  blur->radius_x /= pitch_x;
  blur->radius_y /= pitch_y;
  for (int k = 0; k < 2; k++) {
    blur->edges[k][0] /= pitch_x;
    blur->edges[k][1] /= pitch_y;
  }
}

/* Boundaries alone are not enough where colours vary between them: then samples are summed. */
static cs_defocus_way choose_way(const cs_blur *blur, bool is_own, bool varies) {
  bool is_gaussian = blur->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  if (blur->kind == CELSPAN_DEFOCUS_PIXEL)
    return is_own ? CS_DEFOCUS_MEANS : CS_DEFOCUS_KERNEL;
  if (varies)
    return is_gaussian ? CS_DEFOCUS_SUMS : CS_DEFOCUS_SLICES;
  double least = fmin(cs_defocus_radius(blur, 0), cs_defocus_radius(blur, 1));
  bool has_lines = is_gaussian ? least >= EDGES_GAUSSIAN
                               : blur->kind == CELSPAN_DEFOCUS_BOX && cs_blur_is_upright(blur) &&
                                     least >= EDGES_BOX;
  return has_lines ? CS_DEFOCUS_EDGES : CS_DEFOCUS_KERNEL;
}

static void place_first(cs_defocused *grid) {
  grid->left = grid->first_x - 0.5;
  grid->top = grid->first_y - 0.5;
}

static void init_grid(cs_defocused *grid, int32_t width, int32_t height, int32_t most_rows) {
  grid->columns = cs_number_ceil(width / grid->pitch_x) + 2;
  grid->rows = cs_number_ceil(height / grid->pitch_y) + 2;
  place_first(grid);
  int64_t rows = BAND_BYTES / ((int64_t)grid->columns * 4 * (int64_t)sizeof(float));
  grid->band_rows = (int32_t)cs_number_clamp((double)rows, CS_DEFOCUS_ROWS_LEAST, most_rows);
}

/* Chooses one of the ways, and makes what this way needs. */
static celspan_status init_way(celspan_context *context, cs_defocus *defocus, bool varies,
                               double samples) {
  const cs_blur *s = &defocus->blur;
  defocus->way = choose_way(s, defocus->is_own, varies);
  switch (defocus->way) {
  case CS_DEFOCUS_EDGES:
    return cs_defocus_edges_init(context, s, &defocus->edges);
  case CS_DEFOCUS_SUMS:
    return cs_defocus_sums_init(context, s->radius_x, s->radius_y, samples, &defocus->sums);
  case CS_DEFOCUS_SLICES:
    return cs_defocus_slices_init(context, s, &defocus->slices);
  case CS_DEFOCUS_NEIGHBOURS:
  case CS_DEFOCUS_MEANS:
  case CS_DEFOCUS_KERNEL:
  case CS_DEFOCUS_OWN:
  case CS_DEFOCUS_SHIFTED:
    break;
  }
  return CELSPAN_OK;
}

celspan_status cs_defocus_create(celspan_context *context, const cs_blur *blur, int32_t width,
                                 int32_t height, cs_defocus **out) {
  CS_TRY(cs_defocus_bands_ready(context));
  cs_defocus *defocus;
  CS_TRY(CS_MAKE(context, defocus, 1));
  defocus->owners = 1;
  cs_defocused *grid = &defocus->grid;
  grid->pitch_x = choose_pitch(blur, 0);
  grid->pitch_y = choose_pitch(blur, 1);
  init_grid(grid, width, height, BAND_ROWS);
  defocus->blur = *blur;
  scale_blur(&defocus->blur, grid->pitch_x, grid->pitch_y);
  defocus->is_fine = grid->pitch_x > 1 && grid->pitch_y > 1;
  *out = defocus;
  return CELSPAN_OK;
}

celspan_status cs_defocus_find_way(celspan_context *context, cs_defocus *defocus, bool varies) {
  return init_way(context, defocus, varies, CS_DEFOCUS_SAMPLES);
}

celspan_status cs_defocus_create_own(celspan_context *context, const cs_blur *blur, bool varies,
                                     const int32_t size[2], double samples, cs_defocus **out) {
  cs_defocus *own;
  CS_TRY(CS_MAKE(context, own, 1));
  own->owners = 1;
  own->grid.pitch_x = own->grid.pitch_y = 1;
  init_grid(&own->grid, size[0], size[1], BAND_ROWS_OWN);
  own->blur = *blur;
  own->is_own = true;
  own->is_fine = samples > CS_DEFOCUS_SAMPLES;
  celspan_status status = init_way(context, own, varies, samples);
  if (status == CELSPAN_OK)
    *out = own;
  else
    cs_defocus_free(own, context->memory);
  return status;
}

static celspan_status mix(const cs_defocused *grid, celspan_context *context,
                          cs_defocused_view *view, double y) {
  return cs_regrid_row(&cs_defocus_of(grid)->regrid, grid, context, view, y);
}

void cs_defocus_use_own(cs_defocus *defocus, cs_defocus *own, const double scale[2],
                        const double offset[2]) {
  defocus->own = own;
  defocus->way = CS_DEFOCUS_OWN;
  defocus->grid.planes = own->grid.planes;
  defocus->grid.mix = mix;
  defocus->grid.forget = cs_regrid_forget;
  defocus->grid.are_pixels = defocus->grid.pitch_x == 1 && defocus->grid.pitch_y == 1;
  defocus->regrid = (cs_regrid){&own->grid, {{scale[0], offset[0]}, {scale[1], offset[1]}}};
}

void cs_defocus_use_shift(cs_defocus *defocus, const cs_shifted *shifted, cs_defocus *own,
                          cs_defocus *by) {
  defocus->own = own;
  defocus->by = by;
  defocus->way = CS_DEFOCUS_SHIFTED;
  defocus->grid.planes = own->grid.planes;
  defocus->grid.are_pixels = true;
  defocus->shifted = *shifted;
  defocus->shifted.from = &own->grid;
  defocus->shifted.by = by ? &by->grid : NULL;
}

void cs_defocus_use_pixels(cs_defocus *defocus, const int32_t first[2], const int32_t end[2]) {
  cs_defocused *grid = &defocus->grid;
  grid->pitch_x = grid->pitch_y = 1;
  grid->first_x = first[0] + 1;
  grid->first_y = first[1] + 1;
  grid->columns = end[0] - first[0];
  grid->rows = end[1] - first[1];
  place_first(grid);
  grid->are_pixels = true;
}

int32_t cs_defocus_beyond(const cs_defocus *defocus, int32_t *x, int32_t *y) {
  *x = defocus->edges.extent_x + defocus->sums.extent_x + defocus->slices.extent_x +
       defocus->neighbours.extent[0];
  *y = defocus->edges.extent_y + defocus->sums.extent_y + defocus->slices.extent_y +
       defocus->neighbours.extent[1];
  return defocus->way == CS_DEFOCUS_SUMS     ? defocus->sums.factor
         : defocus->way == CS_DEFOCUS_SLICES ? defocus->slices.factor
                                             : 1;
}

void cs_defocus_raster(const cs_defocus *defocus, int32_t *width, int32_t *height) {
  int32_t extent_x, extent_y, factor = cs_defocus_beyond(defocus, &extent_x, &extent_y);
  *width = factor * defocus->grid.columns + 2 * extent_x;
  *height = factor * defocus->grid.rows + 2 * extent_y;
}

celspan_matrix cs_defocus_matrix(const cs_defocus *defocus) {
  int32_t extent_x, extent_y, factor = cs_defocus_beyond(defocus, &extent_x, &extent_y);
  return celspan_matrix_then(
      celspan_matrix_scaling(factor / defocus->grid.pitch_x, factor / defocus->grid.pitch_y),
      celspan_matrix_translation(factor + extent_x, factor + extent_y));
}

/* The kernel that makes samples from boundaries: it is a square as wide as the blur's own square
 * (which pictures do not need), or as one sample. *out: NULL where the mean over each sample is
 * enough. */
static celspan_status sample_kernel(celspan_context *context, const cs_defocus *defocus,
                                    cs_kernel **out) {
  int32_t extent_x, extent_y, factor = cs_defocus_beyond(defocus, &extent_x, &extent_y);
  double blur = defocus->blur.blur * factor;
  double x = fmax(1, blur / defocus->grid.pitch_x), y = fmax(1, blur / defocus->grid.pitch_y);
  const cs_blur square = {CELSPAN_DEFOCUS_BOX,          0.5 * x, 0.5 * y,
                          {{0.5 * x, 0}, {0, 0.5 * y}}, 1,       {0, 0}};
  if (defocus->is_fine || (defocus->way == CS_DEFOCUS_SLICES && blur == 0))
    return CELSPAN_OK;
  return cs_kernel_create_defocus(context, &square, out);
}

celspan_status cs_defocus_kernel(celspan_context *context, const cs_defocus *defocus,
                                 cs_kernel **out) {
  *out = NULL;
  switch (defocus->way) {
  case CS_DEFOCUS_EDGES:
  case CS_DEFOCUS_NEIGHBOURS:
  case CS_DEFOCUS_MEANS:
  case CS_DEFOCUS_OWN:
  case CS_DEFOCUS_SHIFTED:
    return CELSPAN_OK;
  case CS_DEFOCUS_SUMS:
  case CS_DEFOCUS_SLICES: /* what is sharpened is the mean over each pixel */
    return defocus->blur.kind == CELSPAN_DEFOCUS_PIXEL ? CELSPAN_OK
                                                       : sample_kernel(context, defocus, out);
  case CS_DEFOCUS_KERNEL: /* a pixel's own mean needs no kernel */
    return defocus->blur.kind == CELSPAN_DEFOCUS_PIXEL
               ? CELSPAN_OK
               : cs_kernel_create_defocus(context, &defocus->blur, out);
  }
  return CELSPAN_OK;
}

void cs_defocus_free(cs_defocus *defocus, cs_memory *memory) {
  cs_defocus_edges_finish(&defocus->edges, memory);
  cs_defocus_sums_finish(&defocus->sums, memory);
  cs_defocus_slices_finish(&defocus->slices, memory);
  cs_shifted_finish(&defocus->shifted, memory);
  cs_defocus_neighbours_finish(&defocus->neighbours);
  cs_mem_free(memory, defocus, sizeof *defocus);
}
