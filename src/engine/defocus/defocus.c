#include "engine/defocus/defocus.h"

#include <math.h>
#include <stddef.h>

#include "base/number.h"
#include "engine/defocus/edges.h"
#include "engine/defocus/lines.h"
#include "engine/row/row.h"
#include "engine/sample/defocused.h"

/* ---------------------------------------------------------------- bands made row by row */

/* Bands that are made row after row: of flat art, from its boundaries alone, through the kernel of
 * the plans or line by line (lines.h); and from the cel's own grid (regrid.h).
 *
 *  plan of S --boundaries--> a row of nodes --\                 /--> polyline, where a row of nodes
 *                                              >--> even groups     is a row of pixels,
 *  plan of T --boundaries--> a row of nodes --/                 \--> or every node
 *
 * Only one row of nodes is held at a time, and groups of one colour are neither written nor looked
 * at node by node.
 */

#define GROUP CS_DEFOCUSED_GROUP

/* The maker of one plane, and its row of nodes. */
typedef struct node_plane {
  cs_row_maker maker;
  cs_defocus_lines *lines; /* NULL: the rows go through the kernel of the plan */
  cs_row row;
  float (*nodes)[4];
  bool *even; /* by group */
} node_plane;

typedef struct filling {
  const cs_defocus *defocus;
  const cs_defocused *grid;
  celspan_context *context;
  node_plane planes[2];
  cs_regrid_rows own; /* where the cel has a grid of its own */
  cs_shifted_rows shifted;
  int32_t groups;
} filling;

/* ---------------------------------------------------------------- life */

static celspan_status init_plane(filling *f, int k) {
  const cs_defocus *defocus = f->defocus;
  cs_memory *memory = f->context->memory;
  node_plane *p = &f->planes[k];
  int32_t columns = f->grid->columns;
  cs_row_init(&p->row);
  if (!defocus->own)
    CS_TRY(cs_row_maker_init(&p->maker, f->context, &defocus->plans[k]));
  p->nodes = cs_mem_array(memory, (size_t)columns, sizeof *p->nodes);
  p->even = cs_mem_array(memory, (size_t)f->groups, sizeof *p->even);
  if (!p->nodes || !p->even)
    return cs_fail_memory(f->context);
  return defocus->way == CS_DEFOCUS_EDGES
             ? cs_defocus_lines_create(&defocus->edges, &p->maker, columns, &p->lines)
             : CELSPAN_OK;
}

static void finish_plane(filling *f, int k) {
  cs_memory *memory = f->context->memory;
  node_plane *p = &f->planes[k];
  cs_defocus_lines_free(p->lines);
  cs_row_finish(&p->row, memory);
  cs_mem_free(memory, p->nodes, (size_t)f->grid->columns * sizeof *p->nodes);
  cs_mem_free(memory, p->even, (size_t)f->groups * sizeof *p->even);
  if (!f->defocus->own)
    cs_row_maker_finish(&p->maker);
}

/* ---------------------------------------------------------------- a row of nodes */

static inline int32_t group_end(const filling *f, int32_t i) {
  return i + 1 < f->groups ? (i + 1) * GROUP : f->grid->columns;
}

/* Writes a stretch of one colour. If a whole group lies in it, only the ends of the group are
 * written. */
static void write_single(const filling *f, node_plane *p, const celspan_span *span) {
  cs_v4 colour = cs_v4_load(span->colour);
  for (int32_t x = span->x0, next; x < span->x1; x = next) {
    int32_t end = group_end(f, x / GROUP);
    bool is_even = x % GROUP == 0 && end <= span->x1;
    next = is_even ? end : x + 1;
    p->even[x / GROUP] |= is_even;
    cs_v4_store(p->nodes[x], colour);
    cs_v4_store(p->nodes[next - 1], colour);
  }
}

static celspan_status filter_row(const filling *f, node_plane *p, int32_t y) {
  CS_TRY(cs_row_make(&p->maker, y, &p->row));
  memset(p->even, 0, (size_t)f->groups * sizeof *p->even);
  for (size_t i = 0; i < p->row.count; i++) {
    const celspan_span *span = &p->row.spans[i];
    if (span->kind == CELSPAN_SPAN_SINGLE)
      write_single(f, p, span);
    else
      for (int32_t x = span->x0; x < span->x1; x++)
        celspan_span_colour(span, x, p->nodes[x]);
  }
  return CELSPAN_OK;
}

/* Writes all nodes of an even group. */
static void write_group(const filling *f, node_plane *p, int32_t i) {
  cs_v4 colour = cs_v4_load(p->nodes[i * GROUP]);
  for (int32_t x = i * GROUP; x < group_end(f, i); x++)
    cs_v4_store(p->nodes[x], colour);
  p->even[i] = false;
}

/* Groups are even only where they are even in both planes. */
static void agree(const filling *f, node_plane *a, node_plane *b) {
  for (int32_t i = 0; i < f->groups; i++)
    if (a->even[i] != b->even[i])
      write_group(f, a->even[i] ? a : b, i);
}

static celspan_status make_plane(filling *f, int k, int32_t y) {
  node_plane *p = &f->planes[k];
  if (f->defocus->way == CS_DEFOCUS_SHIFTED)
    return cs_shifted_row(&f->shifted, k, y, p->nodes, p->even);
  return f->defocus->way == CS_DEFOCUS_OWN ? cs_regrid_row(&f->own, k, y, p->nodes, p->even)
         : p->lines                        ? cs_defocus_lines_row(p->lines, y, p->nodes, p->even)
                                           : filter_row(f, p, y);
}

static celspan_status make_nodes(filling *f, int32_t y) {
  int planes = f->grid->planes;
  for (int k = 0; k < planes; k++)
    CS_TRY(make_plane(f, k, y));
  if (planes == 2)
    agree(f, &f->planes[0], &f->planes[1]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a band */

/* Whether only the ends of straight runs of nodes are kept: nothing is interpolated between the
 * rows. */
static bool is_thin(const cs_defocus *defocus) {
  return defocus->grid.pitch_y == 1 && !defocus->is_own;
}

/* Keeps all nodes of a row, as row k of the band. */
static void keep_nodes(filling *f, int32_t k, cs_defocus_band *band) {
  const cs_defocused *grid = f->grid;
  size_t columns = (size_t)grid->columns, size = (size_t)grid->band_rows * columns;
  for (int i = 0; i < grid->planes; i++) {
    node_plane *p = &f->planes[i];
    for (int32_t g = 0; g < f->groups; g++)
      if (p->even[g])
        write_group(f, p, g);
    memcpy(band->nodes + (size_t)i * size + (size_t)k * columns, p->nodes,
           columns * sizeof *p->nodes);
  }
}

static celspan_status keep_vertices(filling *f, cs_defocus_band *band) {
  const node_plane *p = f->planes;
  cs_defocused_nodes nodes = {{(const float(*)[4])p[0].nodes, (const float(*)[4])p[1].nodes},
                              p[0].even};
  return cs_defocus_band_add(f->grid, f->context, &nodes, band);
}

static celspan_status fill_rows(filling *f, int32_t first, int32_t end, cs_defocus_band *band) {
  const cs_defocus *defocus = f->defocus;
  CS_TRY(is_thin(defocus) ? cs_defocus_band_begin(f->context, end - first, band)
                          : cs_defocus_band_room(f->grid, f->context, band));
  if (defocus->way == CS_DEFOCUS_OWN)
    CS_TRY(cs_regrid_begin(&defocus->regrid, f->grid, f->context, &f->own));
  if (defocus->way == CS_DEFOCUS_SHIFTED)
    CS_TRY(cs_shifted_begin(&defocus->shifted, f->grid, f->context, &f->shifted));
  for (int k = 0; k < f->grid->planes; k++)
    CS_TRY(init_plane(f, k));
  for (int32_t y = first; y < end; y++) {
    CS_TRY(make_nodes(f, y));
    if (is_thin(defocus))
      CS_TRY(keep_vertices(f, band));
    else
      keep_nodes(f, y - first, band);
  }
  if (is_thin(defocus))
    cs_defocus_band_end(f->grid, f->context->memory, band);
  return CELSPAN_OK;
}

/* Fills an empty band with the rows [first, end) of nodes. Errors: NO_MEMORY and those of the rows
 * of the plans. */
static CELSPAN_CHECKED celspan_status fill_band(const cs_defocus *defocus, celspan_context *context,
                                                int32_t first, int32_t end, cs_defocus_band *band) {
  filling f = {.defocus = defocus,
               .grid = &defocus->grid,
               .context = context,
               .groups = cs_defocused_groups(&defocus->grid)};
  celspan_status status = fill_rows(&f, first, end, band);
  for (int k = 0; k < f.grid->planes; k++)
    finish_plane(&f, k);
  if (f.own.map)
    cs_regrid_finish(&f.own);
  if (f.shifted.map)
    cs_shifted_end(&f.shifted);
  return status;
}

/* ---------------------------------------------------------------- the cel */

/* Nodes in a radius. Between two nodes a Gaussian then deviates from a line by less than 1/2046
 * (its second derivative is at most 0.242/sigma^2), the rim of a disc by less than 0.9/1023, and
 * the kinks of a box by less than those of an edge. */
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
#define BAND_ROWS_LEAST 8

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

static celspan_status acquire(const cs_defocused *grid, celspan_context *context, int32_t number,
                              cs_defocus_band **out);
static void release(const cs_defocused *grid, celspan_context *context, cs_defocus_band *band) {
  (void)grid;
  cs_defocus_bands_release(context, band);
}

/* Boundaries alone are not enough where colours vary between them: then samples are summed. */
static cs_defocus_way choose_way(const cs_blur *blur, bool varies) {
  bool is_gaussian = blur->kind == CELSPAN_DEFOCUS_GAUSSIAN;
  if (blur->kind == CELSPAN_DEFOCUS_PIXEL)
    return CS_DEFOCUS_KERNEL;
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
  grid->acquire = acquire;
  grid->release = release;
  int64_t rows = BAND_BYTES / ((int64_t)grid->columns * 4 * (int64_t)sizeof(float));
  grid->band_rows = (int32_t)cs_number_clamp((double)rows, BAND_ROWS_LEAST, most_rows);
}

/* Chooses one of the ways, and makes what this way needs. */
static celspan_status init_way(celspan_context *context, cs_defocus *defocus, bool varies,
                               double samples) {
  const cs_blur *s = &defocus->blur;
  defocus->way = choose_way(s, varies);
  switch (defocus->way) {
  case CS_DEFOCUS_EDGES:
    return cs_defocus_edges_init(context, s, &defocus->edges);
  case CS_DEFOCUS_SUMS:
    return cs_defocus_sums_init(context, s->radius_x, s->radius_y, samples, &defocus->sums);
  case CS_DEFOCUS_SLICES:
    return cs_defocus_slices_init(context, s, &defocus->slices);
  case CS_DEFOCUS_NEIGHBOURS:
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

static const cs_defocus *defocus_of(const cs_defocused *grid) {
  return (const cs_defocus *)(const void *)((const char *)grid - offsetof(cs_defocus, grid));
}

void cs_defocus_use_own(cs_defocus *defocus, cs_defocus *own, const double scale[2],
                        const double offset[2]) {
  defocus->own = own;
  defocus->way = CS_DEFOCUS_OWN;
  defocus->grid.planes = own->grid.planes;
  defocus->regrid = (cs_regrid){&own->grid, {{scale[0], offset[0]}, {scale[1], offset[1]}}};
}

void cs_defocus_use_shift(cs_defocus *defocus, const cs_shifted *shifted, cs_defocus *own,
                          cs_defocus *by) {
  defocus->own = own;
  defocus->by = by;
  defocus->way = CS_DEFOCUS_SHIFTED;
  defocus->grid.planes = own->grid.planes;
  defocus->shifted = *shifted;
  defocus->shifted.from = &own->grid;
  defocus->shifted.by = by ? &by->grid : NULL;
}

static celspan_status mix(const cs_defocused *grid, celspan_context *context,
                          cs_defocused_view *view, double y) {
  return cs_regrid_pixels(&defocus_of(grid)->regrid, grid, context, view, y);
}

void cs_defocus_use_pixels(cs_defocus *defocus, const int32_t first[2], const int32_t end[2]) {
  cs_defocused *grid = &defocus->grid;
  grid->pitch_x = grid->pitch_y = 1;
  grid->first_x = first[0] + 1;
  grid->first_y = first[1] + 1;
  grid->columns = end[0] - first[0];
  grid->rows = end[1] - first[1];
  place_first(grid);
  grid->mix = mix;
  grid->forget = cs_regrid_forget;
}

/* Returns how many pixels of the plans a node is wide. *x, *y: how many pixels the plans have
 * beyond the nodes on each side. */
static int32_t find_extent(const cs_defocus *defocus, int32_t *x, int32_t *y) {
  *x = defocus->edges.extent_x + defocus->sums.extent_x + defocus->slices.extent_x +
       defocus->neighbours.extent[0];
  *y = defocus->edges.extent_y + defocus->sums.extent_y + defocus->slices.extent_y +
       defocus->neighbours.extent[1];
  return defocus->way == CS_DEFOCUS_SUMS     ? defocus->sums.factor
         : defocus->way == CS_DEFOCUS_SLICES ? defocus->slices.factor
                                             : 1;
}

void cs_defocus_raster(const cs_defocus *defocus, int32_t *width, int32_t *height) {
  int32_t extent_x, extent_y, factor = find_extent(defocus, &extent_x, &extent_y);
  *width = factor * defocus->grid.columns + 2 * extent_x;
  *height = factor * defocus->grid.rows + 2 * extent_y;
}

celspan_matrix cs_defocus_matrix(const cs_defocus *defocus) {
  int32_t extent_x, extent_y, factor = find_extent(defocus, &extent_x, &extent_y);
  return celspan_matrix_then(
      celspan_matrix_scaling(factor / defocus->grid.pitch_x, factor / defocus->grid.pitch_y),
      celspan_matrix_translation(factor + extent_x, factor + extent_y));
}

/* The kernel that makes samples from boundaries: it is a square as wide as the blur's own square
 * (which pictures do not need), or as one sample. *out: NULL where the mean over each sample is
 * enough. */
static celspan_status sample_kernel(celspan_context *context, const cs_defocus *defocus,
                                    cs_kernel **out) {
  int32_t extent_x, extent_y, factor = find_extent(defocus, &extent_x, &extent_y);
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

/* ---------------------------------------------------------------- a band */

static celspan_status sum_rows(const cs_defocus *defocus, cs_row_maker *maker, int plane,
                               int32_t first, int32_t end, float (*nodes)[4]) {
  int32_t columns = defocus->grid.columns;
  if (defocus->way == CS_DEFOCUS_NEIGHBOURS)
    return cs_defocus_neighbours_fill(&defocus->neighbours, maker, columns, first, end, nodes);
  return defocus->way == CS_DEFOCUS_SUMS
             ? cs_defocus_sums_fill(&defocus->sums, maker, plane, columns, first, end, nodes)
             : cs_defocus_slices_fill(&defocus->slices, maker, columns, first, end, nodes);
}

/* How many node rows are summed together. Rows of samples need much memory, so no more are kept
 * than are needed to outweigh the rows that are made twice. */
static int32_t rows_together(const cs_defocus *defocus) {
  int32_t extent_x, extent_y, factor = find_extent(defocus, &extent_x, &extent_y);
  return (int32_t)cs_number_clamp(4 * extent_y / factor, BAND_ROWS_LEAST, defocus->grid.band_rows);
}

static celspan_status sum_plane(const cs_defocus *defocus, celspan_context *context, int plane,
                                int32_t first, int32_t end, float (*nodes)[4]) {
  cs_row_maker maker;
  celspan_status status = cs_row_maker_init(&maker, context, &defocus->plans[plane]);
  int32_t columns = defocus->grid.columns, step = rows_together(defocus);
  for (int32_t y = first; y < end && status == CELSPAN_OK; y += step)
    status = sum_rows(defocus, &maker, plane, y, end - y < step ? end : y + step,
                      nodes + (size_t)(y - first) * (size_t)columns);
  cs_row_maker_finish(&maker);
  return status;
}

static celspan_status sum_planes(const cs_defocus *defocus, celspan_context *context, int32_t first,
                                 int32_t end, cs_defocus_band *band) {
  const cs_defocused *grid = &defocus->grid;
  size_t size = (size_t)grid->band_rows * (size_t)grid->columns;
  CS_TRY(cs_defocus_band_room(grid, context, band));
  for (int plane = 0; plane < grid->planes; plane++)
    CS_TRY(sum_plane(defocus, context, plane, first, end, band->nodes + (size_t)plane * size));
  return CELSPAN_OK;
}

static celspan_status make_band(const void *layer, celspan_context *context, int32_t number,
                                cs_defocus_band *band) {
  const cs_defocus *defocus = layer;
  const cs_defocused *grid = &defocus->grid;
  int32_t first = number * grid->band_rows;
  int32_t end = grid->rows - first < grid->band_rows ? grid->rows : first + grid->band_rows;
  bool is_summed = defocus->way == CS_DEFOCUS_SUMS || defocus->way == CS_DEFOCUS_SLICES ||
                   defocus->way == CS_DEFOCUS_NEIGHBOURS;
  return is_summed ? sum_planes(defocus, context, first, end, band)
                   : fill_band(defocus, context, first, end, band);
}

static celspan_status acquire(const cs_defocused *grid, celspan_context *context, int32_t number,
                              cs_defocus_band **out) {
  const cs_defocus *defocus = defocus_of(grid);
  cs_defocus_bands_key key = {defocus->key, number};
  return cs_defocus_bands_acquire(context, &key, make_band, defocus, out);
}
