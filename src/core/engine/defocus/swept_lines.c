#include "engine/defocus/swept_lines.h"

#include "base/number.h"
#include "engine/sample/defocused.h"

#include <math.h>

#define PHASES CS_DEFOCUS_EDGES_PHASES
#define GROUP CS_DEFOCUSED_GROUP
/* An edge that crosses fewer columns than this counts as one point. A flatter edge is divided into
 * sections of at most SECTION_WIDTH columns, each of which counts as two points. */
#define UPRIGHT 0.25
#define SECTION_WIDTH 1.5
/* The distance of the two points of Gauss's rule from the middle of a section of length 1. */
#define GAUSS_OFFSET 0.28867513459481287

typedef struct group {
  bool is_marked;   /* an edge of this row is near */
  bool was_marked;  /* an edge of the row above it was near */
  int32_t constant; /* how many of the latest lines have the same colour in this group, */
  int32_t pending;  /* and how many of these, the latest, have not been written yet */
  cs_v4 colour;     /* where constant > 0 */
  cs_v4 below;      /* where !was_marked: what the row above added to the line below it */
} group;

struct cs_defocus_lines {
  const cs_defocus_edges *edges;
  cs_row_maker *maker;
  int32_t columns, group_count;
  int32_t line_count; /* under a node */
  int32_t next;       /* the row to be swept */
  bool has_begun;
  cs_defocus_columns row;
  CS_ARRAY(group, groups);
  CS_ARRAY(cs_v4, lines);         /* a ring of line_count lines */
  CS_ARRAY(const float *, under); /* the lines under a row of nodes, from the middle outwards */
  CS_ARRAY(float, shares);        /* room for the shares of one edge */
  cs_isa isa;
  cs_retained_row retained;
};

/* ---------------------------------------------------------------- life */

celspan_status cs_defocus_lines_create(const cs_defocus_edges *edges, cs_row_maker *maker,
                                       int32_t columns, cs_defocus_lines **out) {
  celspan_context *context = maker->context;
  CS_TRY(CS_MAKE(context, *out, 1));
  cs_defocus_lines *f = *out;
  f->edges = edges;
  f->maker = maker;
  f->columns = columns;
  f->group_count = (columns + GROUP - 1) / GROUP;
  f->line_count = 2 * edges->extent_y;
  f->isa = maker->painter.isa;
  size_t count = (size_t)columns, lines = (size_t)f->line_count;
  CS_TRY(CS_ARRAY_MAKE(context, f->groups, (size_t)f->group_count));
  CS_TRY(CS_ARRAY_MAKE(context, f->row.near, count));
  CS_TRY(CS_ARRAY_MAKE(context, f->row.steps, count));
  CS_TRY(CS_ARRAY_MAKE(context, f->row.below, count));
  CS_TRY(CS_ARRAY_FIT(context, f->lines, count * lines)); /* not read unset */
  CS_TRY(CS_ARRAY_MAKE(context, f->under, lines));
  return CS_ARRAY_MAKE(context, f->shares, 2 * (size_t)edges->extent_x + 2);
}

void cs_defocus_lines_free(cs_defocus_lines *f) {
  if (!f)
    return;
  cs_memory *memory = f->maker->context->memory;
  cs_retained_finish(&f->retained, memory);
  CS_ARRAYS_FREE(memory, &f->row, near, below);
  CS_ARRAYS_FREE(memory, f, groups, shares);
  cs_mem_free(memory, f, sizeof *f);
}

/* ---------------------------------------------------------------- edges */

/* An edge at x at which the colour changes by `step`, in the lines above and below. */
static void add_point(cs_defocus_lines *f, double x, const cs_defocus_halves *step) {
  const cs_defocus_edges *edges = f->edges;
  int32_t extent = edges->extent_x, stride = 2 * extent + 2;
  double at = x - 0.5, column = floor(at), phase = (at - column) * PHASES;
  int32_t row = cs_number_row(phase, PHASES), from = (int32_t)column - 2 * extent; /* nodes */
  const float *low = edges->shares + row * stride, *high = low + stride;
  int32_t first = from > 0 ? 0 : -from, end = f->columns - from;
  end = end > stride ? stride : end;
  if (end <= first)
    return;
  CS_WIDE_CHOOSE(f->isa, cs_defocus_lines_spread)
  (low + first, high + first, (float)(phase - row), end - first, f->shares, step,
   f->row.near + from + first);
  for (int32_t i = (from + first) / GROUP; i <= (from + end - 1) / GROUP; i++)
    f->groups[i].is_marked = true;
}

/* The same edge, for the columns whose kernel lies wholly to the right of it. */
static void pass_point(cs_defocus_lines *f, double x, const cs_border *edge, double upper,
                       double lower) {
  int32_t p = (int32_t)floor(x - 0.5) + 2;
  if (p >= f->columns)
    return;
  p = p > 0 ? p : 0;
  cs_defocus_passed *passed = &f->row.steps[p];
  cs_v4d step = cs_v4d_step(edge->left->colour, edge->right->colour);
  passed->upper = cs_v4d_add(passed->upper, cs_v4d_scale(upper, step));
  passed->lower = cs_v4d_add(passed->lower, cs_v4d_scale(lower, step));
  f->groups[p / GROUP].is_marked = true;
}

static void add_weighed(cs_defocus_lines *f, const cs_border *edge, double x, double height,
                        double depth) {
  double lower = height * depth, upper = height - lower;
  cs_v4 step = edge->right->colour - edge->left->colour;
  const cs_defocus_halves halves = {(float)upper * step, (float)lower * step};
  add_point(f, x, &halves);
  pass_point(f, x, edge, upper, lower);
}

static void add_edge(cs_defocus_lines *f, const cs_border *edge) {
  const cs_segment *line = &edge->line;
  double across = line->xb - line->xa, height = line->yb - line->ya;
  double x = 0.5 * (line->xa + line->xb), depth = 0.5 * (line->ya + line->yb) - f->retained.row;
  double last = f->columns + 2.0 * f->edges->extent_x + 1;
  if (fabs(across) < UPRIGHT) {
    if (x < last)
      add_weighed(f, edge, x, height, depth);
    return;
  }
  int sections = (int)ceil(fabs(across) / SECTION_WIDTH);
  for (int i = 0; i < 2 * sections; i++) {
    double u = (i / 2 + 0.5 + (i % 2 ? GAUSS_OFFSET : -GAUSS_OFFSET)) / sections - 0.5;
    if (x + u * across < last)
      add_weighed(f, edge, x + u * across, 0.5 * height / sections, depth + u * height);
  }
}

/* ---------------------------------------------------------------- lines */

static inline cs_v4 *line_of(const cs_defocus_lines *f, int32_t number) {
  return f->lines + (size_t)(number % f->line_count) * (size_t)f->columns;
}

static inline int32_t group_end(const cs_defocus_lines *f, int32_t i) {
  return i + 1 < f->group_count ? (i + 1) * GROUP : f->columns;
}

/* Writes the pending lines of a group; `number` is the line after them. The line that replaces the
 * oldest line in the ring may be partly written. */
static void write_pending(cs_defocus_lines *f, int32_t i, int32_t number) {
  group *g = &f->groups[i];
  const cs_v4 colour = g->colour;
  int32_t count = g->pending < f->line_count ? g->pending : f->line_count - 1;
  int32_t first = i * GROUP, columns = group_end(f, i) - first;
  for (int32_t k = 1; k <= count; k++) {
    cs_v4 *line = line_of(f, number - k) + first;
    if (columns == GROUP) /* unrolled: the loop itself would cost most of the time */
      for (int32_t p = 0; p < GROUP; p++)
        line[p] = colour;
    else
      for (int32_t p = 0; p < columns; p++)
        line[p] = colour;
  }
  g->pending = 0;
}

/* A group near an edge of this row or of the row above. */
static void sum_group(cs_defocus_lines *f, int32_t i, cs_defocus_passed *sum) {
  group *g = &f->groups[i];
  int32_t first = i * GROUP, end = group_end(f, i), number = f->retained.row;
  write_pending(f, i, number);
  if (!g->was_marked)
    for (int32_t p = first; p < end; p++)
      f->row.below[p] = g->below;
  CS_WIDE_CHOOSE(f->isa, cs_defocus_lines_sum)(&f->row, first, end, sum, line_of(f, number));
  g->constant = 0;
}

/* A group that no edge is near, neither in this row nor in the row above. */
static void keep_group(cs_defocus_lines *f, int32_t i, const cs_defocus_passed *sum) {
  group *g = &f->groups[i];
  cs_v4 colour = g->below + cs_v4_narrow(sum->upper);
  if (g->constant > 0 && !cs_v4_same(g->colour, colour)) {
    write_pending(f, i, f->retained.row);
    g->constant = 0;
  }
  g->constant++;
  g->pending++;
  g->colour = colour;
}

/* Finishes the retained row, and with it the line above the row. */
static void finish_line(cs_defocus_lines *f) {
  cs_v4d half = cs_v4d_scale(0.5, cs_v4_wide(f->retained.base));
  cs_defocus_passed sum = {half, half};
  for (int32_t i = 0; i < f->group_count; i++) {
    group *g = &f->groups[i];
    if (g->is_marked || g->was_marked)
      sum_group(f, i, &sum);
    else
      keep_group(f, i, &sum);
    g->below = cs_v4_narrow(sum.lower);
    g->was_marked = g->is_marked;
    g->is_marked = false;
  }
}

static celspan_status add_row(cs_defocus_lines *f) {
  CS_TRY(cs_row_retain(f->maker, f->next, &f->retained));
  for (size_t i = 0; i < f->retained.edge_count; i++)
    add_edge(f, &f->retained.edges[i]);
  finish_line(f);
  f->next++;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- nodes */

/* The end of the groups from i on that are not constant in all lines under a node. They are weighed
 * together, and all their lines are written. */
static int32_t weighed_end(cs_defocus_lines *f, int32_t i) {
  for (; i < f->group_count && f->groups[i].constant < f->line_count; i++)
    if (f->groups[i].pending > 0)
      write_pending(f, i, f->next);
  return i;
}

static void weigh_groups(cs_defocus_lines *f, int32_t first, int32_t end, float (*nodes)[4],
                         bool *even) {
  for (int32_t i = first; i < end; i++)
    even[i] = false;
  CS_WIDE_CHOOSE(f->isa, cs_defocus_lines_weigh)
  (f->under, f->edges->weights, f->edges->extent_y, 4 * GROUP * first, 4 * group_end(f, end - 1),
   nodes[0]);
}

static void find_lines(cs_defocus_lines *f, int32_t row) {
  int32_t extent = f->edges->extent_y;
  for (int32_t k = 0; k < extent; k++) {
    f->under[2 * k] = (const float *)line_of(f, row + extent - k);
    f->under[2 * k + 1] = (const float *)line_of(f, row + extent + 1 + k);
  }
}

celspan_status cs_defocus_lines_row(cs_defocus_lines *f, int32_t row, float (*nodes)[4],
                                    bool *even) {
  if (!f->has_begun) {
    f->next = row;
    f->has_begun = true;
    for (int32_t i = 0; i < f->group_count; i++)
      f->groups[i].was_marked = true; /* nothing was written for a row above the first one */
  }
  while (f->next <= row + f->line_count)
    CS_TRY(add_row(f));
  find_lines(f, row);
  for (int32_t i = 0, end; i < f->group_count; i = end) {
    end = weighed_end(f, i);
    if (end > i) {
      weigh_groups(f, i, end, nodes, even);
      continue;
    }
    even[i] = true;
    cs_v4_store(nodes[i * GROUP], f->groups[i].colour);
    cs_v4_store(nodes[group_end(f, i) - 1], f->groups[i].colour);
    end = i + 1;
  }
  return CELSPAN_OK;
}
