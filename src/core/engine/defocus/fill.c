#include "engine/defocus/fill.h"

#include "base/number.h"
#include "engine/defocus/swept_lines.h"
#include "engine/row/row.h"

#define GROUP CS_DEFOCUSED_GROUP

/* The maker of one plane, and its row of nodes. */
typedef struct node_plane {
  cs_row_maker maker;
  cs_defocus_lines *lines; /* NULL: the rows go through the kernel of the plan */
  cs_row row;
  float (*nodes)[4];         /* the row that is being made: a row of the band, or `alone` */
  CS_ARRAY(float[4], alone); /* NULL where the band keeps all nodes */
  CS_ARRAY(bool, even);      /* for each group */
} node_plane;

typedef struct filling {
  const cs_defocus *defocus;
  const cs_defocused *grid;
  celspan_context *context;
  node_plane planes[2];
  int32_t groups;
} filling;

/* ---------------------------------------------------------------- life */

/* Whether only the ends of straight runs of nodes are kept: nothing is interpolated between the
 * rows. */
static bool is_thin(const cs_defocus *defocus) {
  return defocus->grid.pitch_y == 1 && !defocus->is_own;
}

static celspan_status init_plane(filling *f, int k) {
  const cs_defocus *defocus = f->defocus;
  node_plane *p = &f->planes[k];
  int32_t columns = f->grid->columns;
  cs_row_init(&p->row);
  CS_TRY(cs_row_maker_init(&p->maker, f->context, &defocus->plans[k]));
  CS_TRY(CS_ARRAY_MAKE(f->context, p->alone, is_thin(defocus) ? (size_t)columns : 0));
  p->nodes = p->alone;
  CS_TRY(CS_ARRAY_MAKE(f->context, p->even, (size_t)f->groups));
  return defocus->way == CS_DEFOCUS_EDGES
             ? cs_defocus_lines_create(&defocus->edges, &p->maker, columns, &p->lines)
             : CELSPAN_OK;
}

static void finish_plane(filling *f, int k) {
  cs_memory *memory = f->context->memory;
  node_plane *p = &f->planes[k];
  cs_defocus_lines_free(p->lines);
  cs_row_finish(&p->row, memory);
  CS_ARRAYS_FREE(memory, p, alone, even);
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
  return p->lines ? cs_defocus_lines_row(p->lines, y, p->nodes, p->even) : filter_row(f, p, y);
}

static celspan_status make_nodes(filling *f, int32_t y) {
  int planes = f->grid->planes;
  for (int k = 0; k < planes; k++)
    CS_TRY(make_plane(f, k, y));
  if (planes == 2)
    agree(f, &f->planes[0], &f->planes[1]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- row by row */

/* Makes all nodes of row y in their place, row k of the band. */
static celspan_status make_kept(filling *f, int32_t y, int32_t k, cs_defocus_band *band) {
  const cs_defocused *grid = f->grid;
  size_t columns = (size_t)grid->columns, size = (size_t)grid->band_rows * columns;
  for (int i = 0; i < grid->planes; i++)
    f->planes[i].nodes = band->nodes + (size_t)i * size + (size_t)k * columns;
  CS_TRY(make_nodes(f, y));
  for (int i = 0; i < grid->planes; i++)
    for (int32_t g = 0; g < f->groups; g++)
      if (f->planes[i].even[g])
        write_group(f, &f->planes[i], g);
  return CELSPAN_OK;
}

static celspan_status make_vertices(filling *f, int32_t y, cs_defocus_band *band) {
  const node_plane *p = f->planes;
  CS_TRY(make_nodes(f, y));
  cs_defocused_nodes nodes = {{(const float(*)[4])p[0].nodes, (const float(*)[4])p[1].nodes},
                              p[0].even};
  return cs_defocus_band_add(f->grid, f->context, &nodes, band);
}

static celspan_status fill_rows(filling *f, int32_t first, int32_t end, cs_defocus_band *band) {
  const cs_defocus *defocus = f->defocus;
  CS_TRY(is_thin(defocus) ? cs_defocus_band_begin(f->context, end - first, band)
                          : cs_defocus_band_room(f->grid, f->context, band));
  for (int k = 0; k < f->grid->planes; k++)
    CS_TRY(init_plane(f, k));
  for (int32_t y = first; y < end; y++)
    CS_TRY(is_thin(defocus) ? make_vertices(f, y, band) : make_kept(f, y, y - first, band));
  return is_thin(defocus) ? cs_defocus_band_end(f->grid, f->context, band) : CELSPAN_OK;
}

/* Fills an empty band with the rows [first, end) of nodes, one after the other. */
static celspan_status fill_band(const cs_defocus *defocus, celspan_context *context, int32_t first,
                                int32_t end, cs_defocus_band *band) {
  filling f = {.defocus = defocus,
               .grid = &defocus->grid,
               .context = context,
               .groups = cs_defocused_groups(&defocus->grid)};
  celspan_status status = fill_rows(&f, first, end, band);
  for (int k = 0; k < f.grid->planes; k++)
    finish_plane(&f, k);
  return status;
}

/* ---------------------------------------------------------------- rows that are made together */

/* Means over pixels, which shifted cels read:
 *
 *     plan --row--> spans: | single | array          | gradient |
 *                            ||       ||               ||
 *     band --row--> nodes: o o o o  o o o o o o o o   o o o o      one for each pixel
 *
 * A grid of a cel's own whose kernel is the pixel needs no more than its rows, pixel by pixel. */
static celspan_status spread_rows(cs_row_maker *maker, cs_row *row, size_t columns, int32_t first,
                                  int32_t end, float (*nodes)[4]) {
  for (int32_t y = first; y < end; y++, nodes += columns) {
    CS_TRY(cs_row_make(maker, y, row));
    for (size_t i = 0; i < row->count; i++)
      cs_row_spread_span(&row->spans[i], row->spans[i].x0, row->spans[i].x1,
                         (cs_v4 *)(void *)nodes[row->spans[i].x0]);
  }
  return CELSPAN_OK;
}

static celspan_status fill_means(celspan_context *context, cs_row_maker *maker, int32_t columns,
                                 int32_t first, int32_t end, float (*nodes)[4]) {
  cs_row row;
  cs_row_init(&row);
  celspan_status status = spread_rows(maker, &row, (size_t)columns, first, end, nodes);
  cs_row_finish(&row, context->memory);
  return status;
}

static celspan_status sum_rows(const cs_defocus *defocus, celspan_context *context,
                               cs_row_maker *maker, int plane, int32_t first, int32_t end,
                               float (*nodes)[4]) {
  int32_t columns = defocus->grid.columns;
  if (defocus->way == CS_DEFOCUS_MEANS)
    return fill_means(context, maker, columns, first, end, nodes);
  if (defocus->way == CS_DEFOCUS_NEIGHBOURS)
    return cs_defocus_neighbours_fill(&defocus->neighbours, maker, columns, first, end, nodes);
  return defocus->way == CS_DEFOCUS_SUMS
             ? cs_defocus_sums_fill(&defocus->sums, maker, plane, columns, first, end, nodes)
             : cs_defocus_slices_fill(&defocus->slices, maker, columns, first, end, nodes);
}

/* How many node rows are summed together. Rows of samples need much memory, so no more are kept
 * than are needed to outweigh the rows that are made twice. */
static int32_t rows_together(const cs_defocus *defocus) {
  int32_t extent_x, extent_y, factor = cs_defocus_beyond(defocus, &extent_x, &extent_y);
  return (int32_t)cs_number_clamp(4 * extent_y / factor, CS_DEFOCUS_ROWS_LEAST,
                                  defocus->grid.band_rows);
}

static celspan_status sum_plane(const cs_defocus *defocus, celspan_context *context, int plane,
                                int32_t first, int32_t end, float (*nodes)[4]) {
  cs_row_maker maker;
  celspan_status status = cs_row_maker_init(&maker, context, &defocus->plans[plane]);
  int32_t columns = defocus->grid.columns, step = rows_together(defocus);
  for (int32_t y = first; y < end && status == CELSPAN_OK; y += step)
    status = sum_rows(defocus, context, &maker, plane, y, end - y < step ? end : y + step,
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

/* ---------------------------------------------------------------- rows along a shift */

static celspan_status shift_rows(const cs_defocused *grid, cs_shifted_rows *rows, int32_t first,
                                 int32_t end, cs_defocus_band *band) {
  size_t columns = (size_t)grid->columns, size = (size_t)grid->band_rows * columns;
  float(*nodes)[4] = band->nodes;
  for (int32_t y = first; y < end; y++, nodes += columns)
    for (int plane = 0; plane < grid->planes; plane++)
      CS_TRY(cs_shifted_row(rows, plane, y, nodes + (size_t)plane * size));
  return CELSPAN_OK;
}

static celspan_status shift_band(const cs_defocus *defocus, celspan_context *context, int32_t first,
                                 int32_t end, cs_defocus_band *band) {
  cs_shifted_rows rows;
  CS_TRY(cs_defocus_band_room(&defocus->grid, context, band));
  celspan_status status = cs_shifted_begin(&defocus->shifted, &defocus->grid, context, &rows);
  if (status == CELSPAN_OK)
    status = shift_rows(&defocus->grid, &rows, first, end, band);
  cs_shifted_end(&rows);
  return status;
}

/* ---------------------------------------------------------------- bands */

static celspan_status make_band(const void *layer, celspan_context *context, int32_t number,
                                cs_defocus_band *band) {
  const cs_defocus *defocus = layer;
  const cs_defocused *grid = &defocus->grid;
  int32_t first = number * grid->band_rows;
  int32_t end = grid->rows - first < grid->band_rows ? grid->rows : first + grid->band_rows;
  if (defocus->way == CS_DEFOCUS_SHIFTED)
    return shift_band(defocus, context, first, end, band);
  bool is_flat = defocus->way == CS_DEFOCUS_KERNEL || defocus->way == CS_DEFOCUS_EDGES;
  return is_flat ? fill_band(defocus, context, first, end, band)
                 : sum_planes(defocus, context, first, end, band);
}

static celspan_status acquire(const cs_defocused *grid, celspan_context *context, int32_t number,
                              cs_defocus_band **out) {
  const cs_defocus *defocus = cs_defocus_of(grid);
  cs_defocus_bands_key key = {defocus->key, number};
  return cs_defocus_bands_acquire(context, &key, make_band, defocus, out);
}

static void release(const cs_defocused *grid, celspan_context *context, cs_defocus_band *band) {
  (void)grid;
  cs_defocus_bands_release(context, band);
}

void cs_defocus_fill_bands(cs_defocus *defocus) {
  defocus->grid.acquire = acquire;
  defocus->grid.release = release;
}
