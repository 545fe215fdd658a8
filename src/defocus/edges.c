#include "defocus/edges.h"

#include "base/elementary.h"
#include "base/number.h"

#include <math.h>

#define PHASES 64 /* places of an edge in its column that shares are tabulated for */
#define FINE 4    /* steps of the integral in a phase */
#define BLOCK 8   /* columns that are constant together or not */
#define SIGMAS 4  /* how far the kernel reaches */
/* Columns that a piece may cross: upright enough to be one point, one part of two points. */
#define UPRIGHT 0.25
#define PART 1.5
#define ROOT                                                                                       \
  0.28867513459481287 /* Gauss: the two points of a part lie this far from its middle              \
                       */

/* ---------------------------------------------------------------- tables */

static size_t share_count(const cs_defocus_edges *edges) {
  return (size_t)(PHASES + 1) * (size_t)(2 * edges->reach_x + 2);
}

/* The share of a kernel left of x. */
typedef struct profile {
  bool is_box;
  double radius; /* BOX */
  double sigma;
  double x, sum, whole; /* GAUSSIAN: the integral up to x, by the rule of middles */
} profile;

/* Brings a Gaussian's integral to x, which must not lie left of where it was. */
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

/* shares[phase][k]: of the kernel about column k - reach left of an edge phase/PHASES right of
 * column 0's centre. */
static void fill_shares(cs_defocus_edges *edges, profile p) {
  int32_t stride = 2 * edges->reach_x + 2, count = PHASES * stride;
  p.x = -edges->reach_x - 1;
  for (int32_t i = 0; i <= count; i++) {
    int32_t phase = (PHASES - i % PHASES) % PHASES, k = (i + PHASES - 1) / PHASES - 1;
    float share = (float)share_left(&p, (double)i / PHASES - edges->reach_x - 1);
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
               .x = -edges->reach_x - 1,
               .whole = 1};
  p.whole = share_left(&p, edges->reach_x + 1);
  p.sum = 0;
  return p;
}

/* What a line k + 1/2 rows away weighs. A Gaussian's tents have spread it already by 1/6. */
static double weight_at(const cs_blur *blur, int32_t k) {
  const double(*e)[2] = blur->edges;
  double variance = 0.25 * blur->radius_y * blur->radius_y - 1.0 / 6, away = k + 0.5;
  return blur->kind == CELSPAN_DEFOCUS_BOX
             ? cs_number_clamp(fabs(e[0][1]) + fabs(e[1][1]) - k, 0, 1)
             : cs_elementary_exp(-0.5 * away * away / variance);
}

static void fill_weights(cs_defocus_edges *edges, const cs_blur *blur) {
  double sum = 0;
  for (int32_t k = edges->reach_y - 1; k >= 0; k--)
    sum += 2 * weight_at(blur, k);
  for (int32_t k = 0; k < edges->reach_y; k++)
    edges->weights[k] = (float)(weight_at(blur, k) / sum);
}

celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                     cs_defocus_edges *out) {
  cs_memory *memory = context->memory;
  const double(*e)[2] = blur->edges;
  bool is_box = blur->kind == CELSPAN_DEFOCUS_BOX;
  double reach_x = is_box ? fabs(e[0][0]) + fabs(e[1][0]) : 0.5 * SIGMAS * blur->radius_x;
  double reach_y = is_box ? fabs(e[0][1]) + fabs(e[1][1]) : 0.5 * SIGMAS * blur->radius_y;
  *out = (cs_defocus_edges){.reach_x = cs_number_ceil(reach_x), .reach_y = cs_number_ceil(reach_y)};
  out->shares = cs_mem_array(memory, share_count(out), sizeof *out->shares);
  out->weights = cs_mem_array(memory, (size_t)out->reach_y, sizeof *out->weights);
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
    cs_mem_free(memory, edges->weights, (size_t)edges->reach_y * sizeof *edges->weights);
  *edges = (cs_defocus_edges){0};
}

/* ---------------------------------------------------------------- rows */

/* What a row adds to the line above it, and to the one below. */
typedef struct halves {
  cs_v4 upper, lower;
} halves;

typedef struct passed {
  cs_v4d upper, lower;
} passed;

typedef struct block {
  bool is_marked;  /* pieces change its columns in this row, */
  bool was_marked; /* in the row above */
  int32_t still;   /* lines up to the last in which it is one colour, the same */
  cs_v4 colour;    /* where still > 0 */
  cs_v4 below;     /* where !was_marked: what the row above added to the line below it */
} block;

typedef struct filling {
  const cs_defocus_edges *edges;
  int32_t columns, block_count;
  halves *near;  /* by column: of the pieces that part the kernel there */
  passed *steps; /* by column: of those that are left of it from there on */
  block *blocks;
  cs_v4 *below;       /* by column: what the row above added to the line below it */
  cs_v4 *lines;       /* a ring of 2 reach_y, of columns each */
  const float **seen; /* those under a row of nodes, from the middle outwards */
  cs_isa isa;
  cs_retained_row retained;
} filling;

static inline cs_v4 *line_of(const filling *f, int32_t number) {
  int32_t place = number % (2 * f->edges->reach_y);
  return f->lines + (size_t)place * (size_t)f->columns;
}

/* An edge at x, where colours change by `step` in the lines above and below. */
static void add_point(filling *f, double x, halves step) {
  const cs_defocus_edges *edges = f->edges;
  int32_t reach = edges->reach_x, stride = 2 * reach + 2;
  double at = x - 0.5, column = floor(at), phase = (at - column) * PHASES;
  int32_t row = (int32_t)phase, from = (int32_t)column - 2 * reach; /* of nodes */
  float t = (float)(phase - row);
  const float *low = edges->shares + row * stride, *high = low + stride;
  int32_t first = from > 0 ? 0 : -from, end = f->columns - from;
  end = end > stride ? stride : end;
  for (int32_t k = first; k < end; k++) {
    float share = low[k] + t * (high[k] - low[k]);
    f->near[from + k].upper += share * step.upper;
    f->near[from + k].lower += share * step.lower;
  }
  for (int32_t p = from + first; p < from + end; p = (p / BLOCK + 1) * BLOCK)
    f->blocks[p / BLOCK].is_marked = true;
}

/* From where the kernel is past an edge at x. */
static void pass_point(filling *f, double x, const cs_retained_edge *piece, double upper,
                       double lower) {
  int32_t p = (int32_t)floor(x - 0.5) + 2;
  if (p >= f->columns)
    return;
  p = p > 0 ? p : 0;
  cs_v4d step = cs_v4d_step(piece->left.colour, piece->right.colour);
  f->steps[p].upper = cs_v4d_add(f->steps[p].upper, cs_v4d_scale(upper, step));
  f->steps[p].lower = cs_v4d_add(f->steps[p].lower, cs_v4d_scale(lower, step));
  f->blocks[p / BLOCK].is_marked = true;
}

static void add_weighed(filling *f, const cs_retained_edge *piece, double x, double height,
                        double depth) {
  double lower = height * depth, upper = height - lower;
  cs_v4 step = piece->right.colour - piece->left.colour;
  add_point(f, x, (halves){(float)upper * step, (float)lower * step});
  pass_point(f, x, piece, upper, lower);
}

static void add_piece(filling *f, const cs_retained_edge *piece) {
  double across = piece->xb - piece->xa, height = piece->yb - piece->ya;
  double x = 0.5 * (piece->xa + piece->xb), depth = 0.5 * (piece->ya + piece->yb) - f->retained.row;
  double last = f->columns + 2.0 * f->edges->reach_x + 1;
  if (fabs(across) < UPRIGHT) {
    if (x < last)
      add_weighed(f, piece, x, height, depth);
    return;
  }
  int parts = (int)ceil(fabs(across) / PART);
  for (int i = 0; i < 2 * parts; i++) {
    double u = (i / 2 + 0.5 + (i % 2 ? ROOT : -ROOT)) / parts - 0.5;
    if (x + u * across < last)
      add_weighed(f, piece, x + u * across, 0.5 * height / parts, depth + u * height);
  }
}

/* ---------------------------------------------------------------- lines */

/* Sums the columns of a block into the line above the row. */
static void sum_block(filling *f, block *b, int32_t first, int32_t end, passed *sum, cs_v4 *line) {
  cs_v4d upper = sum->upper, lower = sum->lower;
  if (!b->was_marked)
    for (int32_t p = first; p < end; p++)
      f->below[p] = b->below;
  for (int32_t p = first; p < end; p++) {
    upper = cs_v4d_add(upper, f->steps[p].upper);
    lower = cs_v4d_add(lower, f->steps[p].lower);
    line[p] = f->below[p] + (cs_v4_narrow(upper) + f->near[p].upper);
    f->below[p] = cs_v4_narrow(lower) + f->near[p].lower;
  }
  *sum = (passed){upper, lower};
  b->still = 0;
  if (!b->is_marked)
    return;
  memset(&f->near[first], 0, (size_t)(end - first) * sizeof *f->near);
  memset(&f->steps[first], 0, (size_t)(end - first) * sizeof *f->steps);
}

/* A block that pieces came near neither in this row nor in the one above. */
static void fill_block(block *b, int32_t first, int32_t end, const passed *sum, cs_v4 *line) {
  cs_v4 colour = b->below + cs_v4_narrow(sum->upper);
  b->still = b->still > 0 && cs_v4_same(b->colour, colour) ? b->still + 1 : 1;
  b->colour = colour;
  for (int32_t p = first; p < end; p++)
    line[p] = colour;
}

static inline int32_t block_end(const filling *f, int32_t i) {
  return i + 1 < f->block_count ? (i + 1) * BLOCK : f->columns;
}

/* Finishes the row that was traced, and the line above it. */
static void finish_line(filling *f) {
  cs_v4 *line = line_of(f, f->retained.row);
  cs_v4d half = cs_v4d_scale(0.5, cs_v4_wide(f->retained.base));
  passed sum = {half, half};
  for (int32_t i = 0; i < f->block_count; i++) {
    block *b = &f->blocks[i];
    if (b->is_marked || b->was_marked)
      sum_block(f, b, i * BLOCK, block_end(f, i), &sum, line);
    else
      fill_block(b, i * BLOCK, block_end(f, i), &sum, line);
    b->below = cs_v4_narrow(sum.lower);
    b->was_marked = b->is_marked;
    b->is_marked = false;
  }
}

static celspan_status add_row(filling *f, cs_row_maker *maker, int32_t row) {
  CS_TRY(cs_row_retain(maker, row, &f->retained));
  for (size_t i = 0; i < f->retained.piece_count; i++)
    add_piece(f, &f->retained.pieces[i]);
  finish_line(f);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- nodes */

/* The last block of those from i on that are weighed together. */
static int32_t weighed_end(const filling *f, int32_t i, int32_t lines) {
  while (i < f->block_count && f->blocks[i].still < lines)
    i++;
  return i;
}

static void fill_nodes(filling *f, int32_t row, float (*nodes)[4]) {
  int32_t reach = f->edges->reach_y;
  for (int32_t k = 0; k < reach; k++) {
    f->seen[2 * k] = (const float *)line_of(f, row + reach - k);
    f->seen[2 * k + 1] = (const float *)line_of(f, row + reach + 1 + k);
  }
  for (int32_t i = 0; i < f->block_count;) {
    int32_t first = i * BLOCK, weighed = weighed_end(f, i, 2 * reach);
    if (weighed > i) {
      int32_t end = block_end(f, weighed - 1);
      CS_WIDE_CHOOSE(f->isa, cs_defocus_edges_weigh)
      (f->seen, f->edges->weights, reach, 4 * first, 4 * end, &nodes[0][0]);
      i = weighed;
      continue;
    }
    for (int32_t p = first; p < block_end(f, i); p++)
      cs_v4_store(nodes[p], f->blocks[i].colour);
    i++;
  }
}

static celspan_status fill_rows(filling *f, cs_row_maker *maker, int32_t first, int32_t end,
                                float (*nodes)[4]) {
  int32_t lines = 2 * f->edges->reach_y;
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
  size_t count = (size_t)columns, lines = 2 * (size_t)edges->reach_y;
  filling f = {.edges = edges,
               .columns = columns,
               .block_count = (columns + BLOCK - 1) / BLOCK,
               .isa = maker->painter.isa};
  size_t blocks = (size_t)f.block_count;
  f.near = cs_mem_array(memory, count, sizeof *f.near);
  f.steps = cs_mem_array(memory, count, sizeof *f.steps);
  f.blocks = cs_mem_array(memory, blocks, sizeof *f.blocks);
  f.below = cs_mem_array(memory, count, sizeof *f.below);
  f.lines = cs_mem_array(memory, count * lines, sizeof *f.lines);
  f.seen = cs_mem_array(memory, lines, sizeof *f.seen);
  bool is_whole = f.near && f.steps && f.blocks && f.below && f.lines && f.seen;
  for (size_t i = 0; is_whole && i < blocks; i++)
    f.blocks[i].was_marked = true; /* nothing is known of the row above the first */
  celspan_status status =
      is_whole ? fill_rows(&f, maker, first, end, nodes) : cs_fail_memory(maker->context);
  cs_retained_finish(&f.retained, memory);
  cs_mem_free(memory, f.near, count * sizeof *f.near);
  cs_mem_free(memory, f.steps, count * sizeof *f.steps);
  cs_mem_free(memory, f.blocks, blocks * sizeof *f.blocks);
  cs_mem_free(memory, f.below, count * sizeof *f.below);
  cs_mem_free(memory, f.lines, count * lines * sizeof *f.lines);
  cs_mem_free(memory, f.seen, lines * sizeof *f.seen);
  return status;
}
