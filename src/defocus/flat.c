#include "defocus/flat.h"

#include "defocus/lines.h"

#define GROUP CS_DEFOCUSED_GROUP

/* What makes one plane, and its row of nodes. */
typedef struct plane {
  cs_row_maker maker;
  cs_defocus_lines *lines; /* NULL: the rows go through the kernel of the plan */
  cs_row row;
  float (*nodes)[4];
  bool *even; /* by group */
} plane;

typedef struct filling {
  const cs_defocus_flat *flat;
  celspan_context *context;
  plane planes[2];
  int32_t groups;
} filling;

/* ---------------------------------------------------------------- life */

static celspan_status init_plane(filling *f, int k) {
  const cs_defocus_flat *flat = f->flat;
  cs_memory *memory = f->context->memory;
  plane *p = &f->planes[k];
  int32_t columns = flat->grid->columns;
  cs_row_init(&p->row);
  CS_TRY(cs_row_maker_init(&p->maker, f->context, &flat->plans[k]));
  p->nodes = cs_mem_array(memory, (size_t)columns, sizeof *p->nodes);
  p->even = cs_mem_array(memory, (size_t)f->groups, sizeof *p->even);
  if (!p->nodes || !p->even)
    return cs_fail_memory(f->context);
  return flat->edges ? cs_defocus_lines_create(flat->edges, &p->maker, columns, &p->lines)
                     : CELSPAN_OK;
}

static void finish_plane(filling *f, int k) {
  cs_memory *memory = f->context->memory;
  plane *p = &f->planes[k];
  cs_defocus_lines_free(p->lines);
  cs_row_finish(&p->row, memory);
  cs_mem_free(memory, p->nodes, (size_t)f->flat->grid->columns * sizeof *p->nodes);
  cs_mem_free(memory, p->even, (size_t)f->groups * sizeof *p->even);
  cs_row_maker_finish(&p->maker);
}

/* ---------------------------------------------------------------- a row of nodes */

static inline int32_t group_end(const filling *f, int32_t i) {
  return i + 1 < f->groups ? (i + 1) * GROUP : f->flat->grid->columns;
}

/* Writes a stretch of one colour; of the groups that lie in it, no more than their ends. */
static void write_single(const filling *f, plane *p, const celspan_span *span) {
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

static celspan_status filter_row(const filling *f, plane *p, int32_t y) {
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
static void write_group(const filling *f, plane *p, int32_t i) {
  cs_v4 colour = cs_v4_load(p->nodes[i * GROUP]);
  for (int32_t x = i * GROUP; x < group_end(f, i); x++)
    cs_v4_store(p->nodes[x], colour);
  p->even[i] = false;
}

/* Groups are even where they are so in both planes. */
static void agree(const filling *f, plane *a, plane *b) {
  for (int32_t i = 0; i < f->groups; i++)
    if (a->even[i] != b->even[i])
      write_group(f, a->even[i] ? a : b, i);
}

static celspan_status make_nodes(filling *f, int32_t y) {
  int planes = f->flat->grid->planes;
  for (int k = 0; k < planes; k++) {
    plane *p = &f->planes[k];
    CS_TRY(p->lines ? cs_defocus_lines_row(p->lines, y, p->nodes, p->even) : filter_row(f, p, y));
  }
  if (planes == 2)
    agree(f, &f->planes[0], &f->planes[1]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- bands */

/* Whether only the ends of straight runs of nodes are kept: nothing is interpolated between the
 * rows. */
static bool is_thin(const cs_defocus_flat *flat) { return flat->grid->pitch_y == 1; }

/* Keeps all nodes of a row, as row k of the band. */
static void keep_nodes(filling *f, int32_t k, cs_defocus_band *band) {
  const cs_defocused *grid = f->flat->grid;
  size_t columns = (size_t)grid->columns, size = (size_t)grid->band_rows * columns;
  for (int i = 0; i < grid->planes; i++) {
    plane *p = &f->planes[i];
    for (int32_t g = 0; g < f->groups; g++)
      if (p->even[g])
        write_group(f, p, g);
    memcpy(band->nodes + (size_t)i * size + (size_t)k * columns, p->nodes,
           columns * sizeof *p->nodes);
  }
}

static celspan_status keep_vertices(filling *f, cs_defocus_band *band) {
  const plane *p = f->planes;
  cs_defocused_nodes nodes = {{(const float(*)[4])p[0].nodes, (const float(*)[4])p[1].nodes},
                              p[0].even};
  return cs_defocus_band_add(f->flat->grid, f->context, &nodes, band);
}

static celspan_status fill_rows(filling *f, int32_t first, int32_t end, cs_defocus_band *band) {
  const cs_defocus_flat *flat = f->flat;
  CS_TRY(is_thin(flat) ? cs_defocus_band_begin(f->context, end - first, band)
                       : cs_defocus_band_room(flat->grid, f->context, band));
  for (int k = 0; k < flat->grid->planes; k++)
    CS_TRY(init_plane(f, k));
  for (int32_t y = first; y < end; y++) {
    CS_TRY(make_nodes(f, y));
    if (is_thin(flat))
      CS_TRY(keep_vertices(f, band));
    else
      keep_nodes(f, y - first, band);
  }
  if (is_thin(flat))
    cs_defocus_band_end(flat->grid, f->context->memory, band);
  return CELSPAN_OK;
}

celspan_status cs_defocus_flat_fill(const cs_defocus_flat *flat, celspan_context *context,
                                    int32_t first, int32_t end, cs_defocus_band *band) {
  filling f = {.flat = flat, .context = context, .groups = cs_defocused_groups(flat->grid)};
  celspan_status status = fill_rows(&f, first, end, band);
  for (int k = 0; k < flat->grid->planes; k++)
    finish_plane(&f, k);
  return status;
}
