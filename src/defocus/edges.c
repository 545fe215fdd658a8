#include "defocus/edges.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>

#define PHASES 64 /* positions of an edge in its column, for which shares are tabulated */
#define FINE 4    /* steps of the integral in a phase */
#define GROUP 8   /* columns in a group: they count as constant together or not at all */
#define SIGMAS 4  /* where a Gaussian is cut off */
/* An edge that crosses fewer columns than this counts as one point. A flatter edge is divided into
 * sections of at most SECTION_WIDTH columns, each of which counts as two points. */
#define UPRIGHT 0.25
#define SECTION_WIDTH 1.5
/* The distance of the two points of Gauss's rule from the middle of a section of length 1. */
#define GAUSS_OFFSET 0.28867513459481287

/* ---------------------------------------------------------------- tables */

static size_t share_count(const cs_defocus_edges *edges) {
  return (size_t)(PHASES + 1) * (size_t)(2 * edges->extent_x + 2);
}

/* The integral of a kernel along x, for increasing x. */
typedef struct profile {
  bool is_box;
  double radius; /* BOX */
  double sigma;
  double x, sum, whole; /* GAUSSIAN: the integral up to x, by the midpoint rule */
} profile;

/* The share of the kernel left of x; x must not decrease from call to call. */
static double share_left(profile *p, double x) {
  if (p->is_box)
    return cs_number_clamp(0.5 + 0.5 * x / p->radius, 0, 1);
  const double step = 1.0 / (PHASES * FINE);
  for (; p->x + 0.5 * step < x; p->x += step) {
    double u = (p->x + 0.5 * step) / p->sigma;
    p->sum += fabs(u) < SIGMAS ? cs_elementary_exp(-0.5 * u * u) : 0;
  }
  return p->sum / p->whole;
}

/* shares[phase][k]: of the kernel around column k - extent_x, the share right of an edge that lies
 * phase/PHASES right of the centre of column 0. The kernel is even, so this is the share left of
 * the mirrored edge. */
static void fill_shares(cs_defocus_edges *edges, profile p) {
  int32_t stride = 2 * edges->extent_x + 2, count = PHASES * stride;
  p.x = -edges->extent_x - 1;
  for (int32_t i = 0; i <= count; i++) {
    int32_t phase = (PHASES - i % PHASES) % PHASES, k = (i + PHASES - 1) / PHASES - 1;
    float share = (float)share_left(&p, (double)i / PHASES - edges->extent_x - 1);
    if (k >= 0 && k < stride)
      edges->shares[phase * stride + k] = share;
    if (phase == 0 && k + 1 < stride)
      edges->shares[PHASES * stride + k + 1] = share;
  }
}

static profile find_profile(const cs_blur *blur, const cs_defocus_edges *edges) {
  const double(*e)[2] = blur->edges;
  profile p = {.is_box = blur->kind == CELSPAN_DEFOCUS_BOX,
               .radius = fabs(e[0][0]) + fabs(e[1][0]),
               .sigma = 0.5 * blur->radius_x,
               .x = -edges->extent_x - 1,
               .whole = 1};
  p.whole = share_left(&p, edges->extent_x + 1);
  p.sum = 0;
  return p;
}

/* The weight of a line k + 1/2 rows away. The tents already spread edges by a variance of 1/6,
 * which is subtracted from that of a Gaussian. */
static double weight_at(const cs_blur *blur, int32_t k) {
  const double(*e)[2] = blur->edges;
  double variance = 0.25 * blur->radius_y * blur->radius_y - 1.0 / 6, away = k + 0.5;
  return blur->kind == CELSPAN_DEFOCUS_BOX
             ? cs_number_clamp(fabs(e[0][1]) + fabs(e[1][1]) - k, 0, 1)
             : cs_elementary_exp(-0.5 * away * away / variance);
}

static void fill_weights(cs_defocus_edges *edges, const cs_blur *blur) {
  double sum = 0;
  for (int32_t k = edges->extent_y - 1; k >= 0; k--)
    sum += 2 * weight_at(blur, k);
  for (int32_t k = 0; k < edges->extent_y; k++)
    edges->weights[k] = (float)(weight_at(blur, k) / sum);
}

celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                     cs_defocus_edges *out) {
  cs_memory *memory = context->memory;
  const double(*e)[2] = blur->edges;
  bool is_box = blur->kind == CELSPAN_DEFOCUS_BOX;
  double extent_x = is_box ? fabs(e[0][0]) + fabs(e[1][0]) : 0.5 * SIGMAS * blur->radius_x;
  double extent_y = is_box ? fabs(e[0][1]) + fabs(e[1][1]) : 0.5 * SIGMAS * blur->radius_y;
  *out = (cs_defocus_edges){.extent_x = cs_number_ceil(extent_x),
                            .extent_y = cs_number_ceil(extent_y)};
  out->shares = cs_mem_array(memory, share_count(out), sizeof *out->shares);
  out->weights = cs_mem_array(memory, (size_t)out->extent_y, sizeof *out->weights);
  if (!out->shares || !out->weights)
    return cs_fail_memory(context);
  fill_shares(out, find_profile(blur, out));
  fill_weights(out, blur);
  return CELSPAN_OK;
}

void cs_defocus_edges_finish(cs_defocus_edges *edges, cs_memory *memory) {
  if (edges->shares)
    cs_mem_free(memory, edges->shares, share_count(edges) * sizeof *edges->shares);
  if (edges->weights)
    cs_mem_free(memory, edges->weights, (size_t)edges->extent_y * sizeof *edges->weights);
  *edges = (cs_defocus_edges){0};
}

/* ---------------------------------------------------------------- rows */

/* What a row adds to the line above it and to the line below it. */
typedef struct halves {
  cs_v4 upper, lower;
} halves;

typedef struct passed {
  cs_v4d upper, lower;
} passed;

typedef struct group {
  bool is_marked;   /* an edge of this row is near */
  bool was_marked;  /* an edge of the row above it was near */
  int32_t constant; /* the number of latest lines in all of which it has one same colour */
  cs_v4 colour;     /* where constant > 0 */
  cs_v4 below;      /* where !was_marked: what the row above added to the line below it */
} group;

typedef struct filling {
  const cs_defocus_edges *edges;
  int32_t columns, group_count;
  halves *near;  /* by column: of edges inside the kernel of the column */
  passed *steps; /* by column: of edges that are left of the kernel from this column on */
  group *groups;
  cs_v4 *below;        /* by column: what the row above added to the line below it */
  cs_v4 *lines;        /* a ring of 2 extent_y lines */
  const float **under; /* the lines under a row of nodes, from the middle outwards */
  cs_isa isa;
  cs_retained_row retained;
} filling;

static inline cs_v4 *line_of(const filling *f, int32_t number) {
  int32_t place = number % (2 * f->edges->extent_y);
  return f->lines + (size_t)place * (size_t)f->columns;
}

/* An edge at x at which the colour changes by `step`, in the lines above and below. */
static void add_point(filling *f, double x, halves step) {
  const cs_defocus_edges *edges = f->edges;
  int32_t extent = edges->extent_x, stride = 2 * extent + 2;
  double at = x - 0.5, column = floor(at), phase = (at - column) * PHASES;
  int32_t row = (int32_t)phase, from = (int32_t)column - 2 * extent; /* of nodes */
  float t = (float)(phase - row);
  const float *low = edges->shares + row * stride, *high = low + stride;
  int32_t first = from > 0 ? 0 : -from, end = f->columns - from;
  end = end > stride ? stride : end;
  for (int32_t k = first; k < end; k++) {
    float share = low[k] + t * (high[k] - low[k]);
    f->near[from + k].upper += share * step.upper;
    f->near[from + k].lower += share * step.lower;
  }
  for (int32_t p = from + first; p < from + end; p = (p / GROUP + 1) * GROUP)
    f->groups[p / GROUP].is_marked = true;
}

/* The same edge, for the columns whose kernel lies wholly right of it. */
static void pass_point(filling *f, double x, const cs_retained_edge *edge, double upper,
                       double lower) {
  int32_t p = (int32_t)floor(x - 0.5) + 2;
  if (p >= f->columns)
    return;
  p = p > 0 ? p : 0;
  cs_v4d step = cs_v4d_step(edge->left.colour, edge->right.colour);
  f->steps[p].upper = cs_v4d_add(f->steps[p].upper, cs_v4d_scale(upper, step));
  f->steps[p].lower = cs_v4d_add(f->steps[p].lower, cs_v4d_scale(lower, step));
  f->groups[p / GROUP].is_marked = true;
}

static void add_weighed(filling *f, const cs_retained_edge *edge, double x, double height,
                        double depth) {
  double lower = height * depth, upper = height - lower;
  cs_v4 step = edge->right.colour - edge->left.colour;
  add_point(f, x, (halves){(float)upper * step, (float)lower * step});
  pass_point(f, x, edge, upper, lower);
}

static void add_edge(filling *f, const cs_retained_edge *edge) {
  double across = edge->xb - edge->xa, height = edge->yb - edge->ya;
  double x = 0.5 * (edge->xa + edge->xb), depth = 0.5 * (edge->ya + edge->yb) - f->retained.row;
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

/* Fills the columns of a group in the line above the row. */
static void sum_group(filling *f, group *g, int32_t first, int32_t end, passed *sum, cs_v4 *line) {
  cs_v4d upper = sum->upper, lower = sum->lower;
  if (!g->was_marked)
    for (int32_t p = first; p < end; p++)
      f->below[p] = g->below;
  for (int32_t p = first; p < end; p++) {
    upper = cs_v4d_add(upper, f->steps[p].upper);
    lower = cs_v4d_add(lower, f->steps[p].lower);
    line[p] = f->below[p] + (cs_v4_narrow(upper) + f->near[p].upper);
    f->below[p] = cs_v4_narrow(lower) + f->near[p].lower;
  }
  *sum = (passed){upper, lower};
  g->constant = 0;
  if (!g->is_marked)
    return;
  memset(&f->near[first], 0, (size_t)(end - first) * sizeof *f->near);
  memset(&f->steps[first], 0, (size_t)(end - first) * sizeof *f->steps);
}

/* The same for a group that no edge is near, neither in this row nor in the row above. */
static void fill_group(group *g, int32_t first, int32_t end, const passed *sum, cs_v4 *line) {
  cs_v4 colour = g->below + cs_v4_narrow(sum->upper);
  g->constant = g->constant > 0 && cs_v4_same(g->colour, colour) ? g->constant + 1 : 1;
  g->colour = colour;
  for (int32_t p = first; p < end; p++)
    line[p] = colour;
}

static inline int32_t group_end(const filling *f, int32_t i) {
  return i + 1 < f->group_count ? (i + 1) * GROUP : f->columns;
}

/* Finishes the retained row, and with it the line above the row. */
static void finish_line(filling *f) {
  cs_v4 *line = line_of(f, f->retained.row);
  cs_v4d half = cs_v4d_scale(0.5, cs_v4_wide(f->retained.base));
  passed sum = {half, half};
  for (int32_t i = 0; i < f->group_count; i++) {
    group *g = &f->groups[i];
    if (g->is_marked || g->was_marked)
      sum_group(f, g, i * GROUP, group_end(f, i), &sum, line);
    else
      fill_group(g, i * GROUP, group_end(f, i), &sum, line);
    g->below = cs_v4_narrow(sum.lower);
    g->was_marked = g->is_marked;
    g->is_marked = false;
  }
}

static celspan_status add_row(filling *f, cs_row_maker *maker, int32_t row) {
  CS_TRY(cs_row_retain(maker, row, &f->retained));
  for (size_t i = 0; i < f->retained.edge_count; i++)
    add_edge(f, &f->retained.edges[i]);
  finish_line(f);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- nodes */

/* The end of the groups from i on that are not constant in the last `lines` lines. They are weighed
 * together. */
static int32_t weighed_end(const filling *f, int32_t i, int32_t lines) {
  while (i < f->group_count && f->groups[i].constant < lines)
    i++;
  return i;
}

static void fill_nodes(filling *f, int32_t row, float (*nodes)[4]) {
  int32_t extent = f->edges->extent_y;
  for (int32_t k = 0; k < extent; k++) {
    f->under[2 * k] = (const float *)line_of(f, row + extent - k);
    f->under[2 * k + 1] = (const float *)line_of(f, row + extent + 1 + k);
  }
  for (int32_t i = 0; i < f->group_count;) {
    int32_t first = i * GROUP, weighed = weighed_end(f, i, 2 * extent);
    if (weighed > i) {
      int32_t end = group_end(f, weighed - 1);
      CS_WIDE_CHOOSE(f->isa, cs_defocus_edges_weigh)
      (f->under, f->edges->weights, extent, 4 * first, 4 * end, &nodes[0][0]);
      i = weighed;
      continue;
    }
    for (int32_t p = first; p < group_end(f, i); p++)
      cs_v4_store(nodes[p], f->groups[i].colour);
    i++;
  }
}

static celspan_status fill_rows(filling *f, cs_row_maker *maker, int32_t first, int32_t end,
                                float (*nodes)[4]) {
  int32_t lines = 2 * f->edges->extent_y;
  for (int32_t row = first; row < end + lines; row++) {
    CS_TRY(add_row(f, maker, row));
    if (row >= first + lines)
      fill_nodes(f, row - lines, nodes + (size_t)(row - lines - first) * (size_t)f->columns);
  }
  return CELSPAN_OK;
}

celspan_status cs_defocus_edges_fill(const cs_defocus_edges *edges, cs_row_maker *maker,
                                     int32_t columns, int32_t first, int32_t end,
                                     float (*nodes)[4]) {
  cs_memory *memory = maker->context->memory;
  size_t count = (size_t)columns, lines = 2 * (size_t)edges->extent_y;
  filling f = {.edges = edges,
               .columns = columns,
               .group_count = (columns + GROUP - 1) / GROUP,
               .isa = maker->painter.isa};
  size_t groups = (size_t)f.group_count;
  f.near = cs_mem_array(memory, count, sizeof *f.near);
  f.steps = cs_mem_array(memory, count, sizeof *f.steps);
  f.groups = cs_mem_array(memory, groups, sizeof *f.groups);
  f.below = cs_mem_array(memory, count, sizeof *f.below);
  f.lines = cs_mem_array(memory, count * lines, sizeof *f.lines);
  f.under = cs_mem_array(memory, lines, sizeof *f.under);
  bool is_whole = f.near && f.steps && f.groups && f.below && f.lines && f.under;
  for (size_t i = 0; is_whole && i < groups; i++)
    f.groups[i].was_marked = true; /* there is no row above the first one */
  celspan_status status =
      is_whole ? fill_rows(&f, maker, first, end, nodes) : cs_fail_memory(maker->context);
  cs_retained_finish(&f.retained, memory);
  cs_mem_free(memory, f.near, count * sizeof *f.near);
  cs_mem_free(memory, f.steps, count * sizeof *f.steps);
  cs_mem_free(memory, f.groups, groups * sizeof *f.groups);
  cs_mem_free(memory, f.below, count * sizeof *f.below);
  cs_mem_free(memory, f.lines, count * lines * sizeof *f.lines);
  cs_mem_free(memory, f.under, lines * sizeof *f.under);
  return status;
}
