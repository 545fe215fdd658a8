/* Scattering: where the colour steps of the edges under a kernel go, column by column. It is the
 * first half of a filtered row; filter.c is the second.
 *
 *      kernel of the pixel at column p       a retained edge, cut to the heights of the kernel and
 *          _____                             into segments so short that each may be upright
 *         /     \
 *      --|---p---|--------/------            columns whose kernel is left of it: nothing
 *         \_____/        /                   columns whose kernel it divides: a share of the step
 *                       /                    columns whose kernel is right of it: the whole step,
 *                                            which is a change at the first of them, and for signed
 *                                            kernels a passed event
 *
 * One file, because separable and even kernels share the steps of an edge.
 */
#include "engine/kernel/convolve_parts.h"

#include <math.h>

#include "base/number.h"

/* The work of one row. */
typedef struct cs_scatter {
  cs_convolve *convolve;
  celspan_context *context;
  double centre;                   /* height of the row that is made */
  const cs_retained_row *retained; /* the row that is read */
  uint32_t row;                    /* the number of that row among the rows under the kernel */
  uint32_t *terms;                 /* the terms of the retained row's cells that vary */
} cs_scatter;

/* floor for the places of edges, which are numbers of columns: with fewer instructions than a floor
 * for all numbers. */
static inline int32_t whole_below(double x) {
  int32_t whole = (int32_t)x;
  return whole - (x < whole);
}

/* ---------------------------------------------------------------- columns */

static void begin_column(cs_convolve *convolve, int32_t p) {
  convolve->changes[p] = (cs_v4d){0};
  if (convolve->slopes)
    convolve->slopes[p] = (cs_v4d){0};
  convolve->values[p] = cs_v4_all(0);
  convolve->shifts_at[p] = 0;
  if (convolve->kernel->is_signed) {
    convolve->passed_at[p] = 0;
    convolve->near[p] = cs_convolve_nothing();
  }
}

static inline void touch(cs_convolve *convolve, int32_t p) {
  uint64_t bit = (uint64_t)1 << (p % 64), *word = &convolve->touched[p / 64];
  if (*word & bit)
    return;
  begin_column(convolve, p);
  *word |= bit;
}

static inline void shift_term(const cs_scatter *g, int32_t p, const cs_cell *cell, double weight) {
  cs_convolve *convolve = g->convolve;
  if (cell->length == 0)
    return;
  uint32_t term = g->terms[cs_retained_number(g->retained, cell)];
  convolve->shifts[convolve->shift_count++] =
      (cs_convolve_shift){convolve->shifts_at[p], term, weight};
  convolve->shifts_at[p] = (uint32_t)convolve->shift_count;
}

/* Makes room for steps at `columns` columns. Errors: NO_MEMORY. */
static celspan_status reserve_shifts(const cs_scatter *g, int32_t columns) {
  cs_convolve *convolve = g->convolve;
  return CS_ARRAY_RESERVE(g->context, convolve->shifts,
                          convolve->shift_count + 2 * (size_t)columns);
}

/* Adds the step between two colours that are programs. There is room for it. */
static inline void add_shift(const cs_scatter *g, const cs_border *edge, int32_t p, double weight) {
  shift_term(g, p, edge->left, -weight);
  shift_term(g, p, edge->right, weight);
}

/* From column p on, which is touched, the share of the colour right of the edge grows by `weight`,
 * and the share of the colour left of the edge shrinks by the same amount. */
static void add_step(cs_scatter *g, const cs_border *edge, int32_t p, double weight) {
  cs_v4d *sum = &g->convolve->changes[p];
  cs_v4d step = cs_v4d_step(edge->left->colour, edge->right->colour);
  *sum = cs_v4d_add(*sum, cs_v4d_scale(weight, step));
}

/* ---------------------------------------------------------------- edges */

static bool cut_line(const cs_segment *line, double top, double foot, cs_segment *out) {
  double slope = (line->xb - line->xa) / (line->yb - line->ya);
  *out = *line;
  if (line->yb <= top || line->ya >= foot)
    return false;
  if (line->ya < top) {
    out->ya = top;
    out->xa = line->xa + (top - line->ya) * slope;
  }
  if (line->yb > foot) {
    out->yb = foot;
    out->xb = line->xa + (foot - line->ya) * slope;
  }
  return true;
}

static bool has_flat_sides(const cs_border *edge) {
  return (edge->left->length | edge->right->length) == 0;
}

/* ------------------------------------------------------ an edge under a separable kernel */

/* An edge under a separable kernel.
 *
 *            /  ya
 *           /  } segment    an edge is cut into segments so short that each may count as upright at
 *          /   } segment    its middle x, with the share of the kernel at its heights as its weight
 *         /  yb
 *
 *      column   p-2   p-1    p    p+1   p+2
 *      share     0    .1    .5    .9     1      a row of the kernel's table: which shares of its
 *                                               weight a segment adds to the columns around it
 *
 * The shares of all segments within a stretch of about a column are summed first, so that the
 * colour step of the edge is added once a column.
 */
#define STRETCH 1.0 /* columns that segments summed together may cross */
#define WIDEST 0.25 /* columns that one segment may cross */

/* The number of segments into which an edge is cut. The error of a segment grows as the product of
 * its height and its width. */
static int count_segments(const cs_kernel *kernel, double height, double across) {
  double wanted = kernel->rows * kernel->sharpness * sqrt(height * across);
  double least = across * kernel->sharpness / WIDEST;
  return -whole_below(-cs_number_most(wanted, cs_number_most(least, 1)));
}

/* Segments that are summed together. They divide the kernels of the columns [first, end); in the
 * columns after, their weight counts as a whole. */
typedef struct stretch {
  int32_t first, end;
  double weight;
} stretch;

/* Adds the shares of a segment at x to the sums of a stretch, a number for each column. */
static void add_segment(const cs_kernel *kernel, const stretch *s, double x, float weight,
                        float *sums) {
  int32_t column = whole_below(x - 0.5);
  double phase = (x - 0.5 - column) * kernel->phases;
  /* Just left of a centre, phase rounds to `phases`. */
  int32_t row = cs_number_row(phase, kernel->phases), stride = kernel->stride;
  float t = (float)(phase - row);
  const float *low = kernel->shares + (size_t)row * (size_t)stride, *high = low + stride;
  float *out = sums + (column - kernel->columns - s->first), *end = sums + (s->end - s->first);
  cs_v4 near = cs_v4_all(weight * (1 - t)), far = cs_v4_all(weight * t);
  for (int32_t k = 0; k < stride; k += 4)
    cs_v4_store(out + k,
                cs_v4_load(out + k) + (near * cs_v4_load(low + k) + far * cs_v4_load(high + k)));
  for (float *rest = out + stride; rest < end; rest++)
    *rest += weight;
}

/* The first sub-row of the retained row whose middle is at or below height y. */
static int first_sub_row(const cs_scatter *g, double y) {
  double sub_row = ceil((y - g->retained->row) * CS_CONVOLVE_SUB_ROWS - 0.5);
  return (int)cs_number_clamp(sub_row, 0, CS_CONVOLVE_SUB_ROWS);
}

/* Notes that from column p on the kernel has passed the heights y0..y1 of an edge. */
static celspan_status add_passed(cs_scatter *g, const cs_border *edge, int32_t p, double y0,
                                 double y1) {
  cs_convolve *convolve = g->convolve;
  int sub_row = first_sub_row(g, y0), sub_row_end = first_sub_row(g, y1);
  if (sub_row == sub_row_end)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(g->context, convolve->passed, convolve->passed_count + 1));
  cs_convolve_passed *passed = &convolve->passed[convolve->passed_count++];
  *passed = (cs_convolve_passed){.next = convolve->passed_at[p],
                                 .row = g->row,
                                 .sub_row = sub_row,
                                 .sub_row_end = sub_row_end,
                                 .varies = (edge->right->length > 0) - (edge->left->length > 0)};
  passed->step = cs_v4d_step(edge->left->colour, edge->right->colour);
  convolve->passed_at[p] = (uint32_t)convolve->passed_count;
  return CELSPAN_OK;
}

static cs_convolve_range range_of(const cs_border *edge) {
  cs_convolve_range range = cs_convolve_nothing();
  if (edge->left->length == 0)
    cs_convolve_widen(&range, edge->left->colour);
  if (edge->right->length == 0)
    cs_convolve_widen(&range, edge->right->colour);
  return range;
}

/* The term of the cell at one side of an edge grows, in the columns [first, end), by `sign` times
 * what the shares, one for each of them, grow by. There is room for these steps. */
static void shift_columns(const cs_scatter *g, const cs_cell *cell, double sign, int32_t first,
                          int32_t end, const float *shares) {
  cs_convolve *convolve = g->convolve;
  if (cell->length == 0)
    return;
  uint32_t term = g->terms[cs_retained_number(g->retained, cell)], *last = convolve->shifts_at;
  cs_convolve_shift *shift = convolve->shifts + convolve->shift_count;
  uint32_t number = (uint32_t)convolve->shift_count;
  double before = 0;
  for (int32_t p = first; p < end; p++) {
    double share = (double)shares[p - first];
    *shift++ = (cs_convolve_shift){last[p], term, sign * (share - before)};
    last[p] = ++number;
    before = share;
  }
  convolve->shift_count = number;
}

/* Adds the colour step of a stretch to its columns, by the sums of its segments. */
static celspan_status put_stretch(cs_scatter *g, const cs_border *edge, const stretch *s,
                                  const float *sums) {
  cs_convolve *convolve = g->convolve;
  cs_v4 step = edge->right->colour - edge->left->colour;
  int32_t first = s->first > 0 ? s->first : 0;
  int32_t end = s->end < convolve->width ? s->end : convolve->width;
  int32_t count = end > first ? end - first : 0;
  const float *shares = count > 0 ? sums + (first - s->first) : sums;
  cs_v4 *values = convolve->values;
  for (int32_t p = first; p < end; p++) {
    touch(convolve, p);
    values[p] += shares[p - first] * step;
  }
  if (!has_flat_sides(edge)) {
    CS_TRY(reserve_shifts(g, count + 1));
    shift_columns(g, edge->left, -1, first, end, shares);
    shift_columns(g, edge->right, 1, first, end, shares);
  }
  if (convolve->kernel->is_signed) {
    cs_convolve_range range = range_of(edge);
    for (int32_t p = first; p < end; p++)
      convolve->near[p] = cs_convolve_both(convolve->near[p], range);
  }
  if (s->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = s->end > 0 ? s->end : 0;
  touch(convolve, rest);
  add_step(g, edge, rest, s->weight);
  add_shift(g, edge, rest, s->weight - (count > 0 ? (double)shares[count - 1] : 0));
  return CELSPAN_OK;
}

/* Adds the stretch `cut` of an edge, in `count` segments that are summed together. */
static celspan_status add_stretch(cs_scatter *g, const cs_border *edge, const cs_segment *cut,
                                  int count) {
  const cs_kernel *kernel = g->convolve->kernel;
  float *sums = g->convolve->sums;
  double low = cs_number_least(cut->xa, cut->xb) - 0.5;
  double high = cs_number_most(cut->xa, cut->xb) - 0.5;
  double above = cs_kernel_above(kernel, cut->ya - g->centre), begin = above;
  stretch s = {whole_below(low) - kernel->columns, whole_below(high) + kernel->columns + 2, 0};
  if (s.first >= g->convolve->width)
    return CELSPAN_OK;
  memset(sums, 0, (size_t)(s.end - s.first + kernel->stride) * sizeof *sums);
  double across = (cut->xb - cut->xa) / count, down = (cut->yb - cut->ya) / count;
  for (int k = 1; k <= count; k++) {
    double foot = k == count ? cut->yb : cut->ya + k * down;
    double below = cs_kernel_above(kernel, foot - g->centre);
    if (s.end > 0)
      add_segment(kernel, &s, cut->xa + (k - 0.5) * across, (float)(below - above), sums);
    above = below;
  }
  s.weight = above - begin;
  CS_TRY(put_stretch(g, edge, &s, sums));
  return kernel->is_signed && s.end < g->convolve->width
             ? add_passed(g, edge, s.end > 0 ? s.end : 0, cut->ya, cut->yb)
             : CELSPAN_OK;
}

static celspan_status scatter_separable(cs_scatter *g, const cs_border *edge) {
  const cs_kernel *kernel = g->convolve->kernel;
  cs_segment within, cut;
  if (!cut_line(&edge->line, g->centre - kernel->radius_y, g->centre + kernel->radius_y, &within))
    return CELSPAN_OK;
  double height = within.yb - within.ya, across = within.xb - within.xa;
  int stretches = -whole_below(-cs_number_most(fabs(across) / STRETCH, 1));
  int segments = count_segments(kernel, height, fabs(across));
  segments = (segments + stretches - 1) / stretches;
  cut = within;
  for (int k = 1; k <= stretches; k++) {
    double u = (double)k / stretches;
    cut.xb = k == stretches ? within.xb : within.xa + u * across;
    cut.yb = k == stretches ? within.yb : within.ya + u * height;
    CS_TRY(add_stretch(g, edge, &cut, segments));
    cut.xa = cut.xb;
    cut.ya = cut.yb;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- an edge under an even shape */

/* An edge under an even shape: at each height the kernel is one interval, its chord, in which it is
 * constant.
 *
 *         ___--/---___
 *       /     /        \        the edge is cut into segments by height
 *      |     /          |
 *      |====*===========|       the kernel's chord at the middle height of a segment: the share of
 *       \   |          /        the chord right of the segment is the share of the segment's weight
 *         --|______---          that the pixel gets
 *
 * A long chord over an upright segment is a ramp along the columns: one change of slope where it
 * begins, and one where it ends.
 */
#define NARROW 1e-4  /* segments that cross less of a chord count as upright */
#define NOTHING 1e-9 /* shorter chords have no weight worth adding */
/* columns; where chords are longer, segments that cross few columns are treated as ramps */
#define RAMP 8

/* A segment of an edge, and the share of the kernel at its heights. */
typedef struct segment {
  double low, high; /* x */
  double from, to;  /* the kernel's chord at its middle height, relative to the kernel's centre */
  double weight;
  /* columns whose kernel it divides; from `end` on, the kernel lies wholly right of it */
  int32_t first, end;
} segment;

static double half_square(double v) { return v > 0 ? 0.5 * v * v : 0; }

/* The share of the chord of a kernel with centre c that lies right of a segment, as a mean over the
 * segment's heights. scale: 1 / the chord's length, divided by the width of the segment too unless
 * the segment is upright. */
static double share_right(const segment *t, double c, bool is_upright, double scale) {
  if (is_upright)
    return cs_number_clamp((c + t->to - 0.5 * (t->low + t->high)) * scale, 0, 1);
  return (half_square(c + t->to - t->low) - half_square(c + t->from - t->low) -
          half_square(c + t->to - t->high) + half_square(c + t->from - t->high)) *
         scale;
}

/* Adds a segment to each column whose kernel it divides, and as a whole to the columns after. */
static celspan_status spread(cs_scatter *g, const cs_border *edge, const segment *t) {
  cs_convolve *convolve = g->convolve;
  double before = 0, length = t->to - t->from, across = t->high - t->low;
  bool is_upright = across < NARROW * length, is_flat = has_flat_sides(edge);
  double scale = 1 / (is_upright ? length : length * across);
  cs_v4 step = (float)t->weight * (edge->right->colour - edge->left->colour);
  int32_t first = t->first > 0 ? t->first : 0;
  int32_t stop = t->end < convolve->width ? t->end : convolve->width;
  if (!is_flat)
    CS_TRY(reserve_shifts(g, (stop > first ? stop - first : 0) + 1));
  for (int32_t p = first; p < stop; p++) {
    double now = share_right(t, p + 0.5, is_upright, scale);
    touch(convolve, p);
    convolve->values[p] += (float)now * step;
    if (!is_flat)
      add_shift(g, edge, p, t->weight * (now - before));
    before = now;
  }
  if (t->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = t->end > 0 ? t->end : 0;
  touch(convolve, rest);
  add_step(g, edge, rest, t->weight);
  add_shift(g, edge, rest, t->weight * (1 - before));
  return CELSPAN_OK;
}

static void tilt(cs_scatter *g, const cs_border *edge, int32_t p, double slope) {
  cs_v4d *sum = &g->convolve->slopes[p];
  cs_v4d step = cs_v4d_step(edge->left->colour, edge->right->colour);
  *sum = cs_v4d_add(*sum, cs_v4d_scale(slope, step));
}

/* An upright segment between flat colours under a chord is a ramp: one change where it begins, one
 * where it ends. */
static void spread_ramp(cs_scatter *g, const cs_border *edge, const segment *t) {
  cs_convolve *convolve = g->convolve;
  double x = 0.5 * (t->low + t->high), slope = 1 / (t->to - t->from);
  int32_t first = cs_number_first_centre(x - t->to), end = cs_number_first_centre(x - t->from);
  first = first > 0 ? first : 0;
  if (first >= convolve->width)
    return;
  double now = end > first ? (first + 0.5 + t->to - x) * slope : 1;
  touch(convolve, first);
  add_step(g, edge, first, t->weight * now);
  if (end <= first)
    return;
  tilt(g, edge, first, t->weight * slope);
  if (end >= convolve->width)
    return;
  touch(convolve, end);
  tilt(g, edge, end, -t->weight * slope);
  add_step(g, edge, end, t->weight * (1 - (now + (end - first) * slope)));
}

static celspan_status add_even_segment(cs_scatter *g, const cs_border *edge, segment *t) {
  if (t->weight == 0)
    return CELSPAN_OK;
  t->first = cs_number_first_centre(t->low - t->to);
  t->end = cs_number_first_centre(t->high - t->from);
  bool is_ramp = t->end - t->first > RAMP && t->high - t->low <= (t->to - t->from) / RAMP &&
                 has_flat_sides(edge);
  if (!is_ramp)
    return spread(g, edge, t);
  spread_ramp(g, edge, t);
  return CELSPAN_OK;
}

/* The number of segments into which an edge is cut, so that the chord of the kernel is nearly
 * constant over the heights of each segment; the chord of an upright box is the same at all
 * heights. */
static int count_even_segments(const cs_kernel *kernel, const cs_segment *line) {
  double height = line->yb - line->ya, across = fabs(line->xb - line->xa);
  bool is_upright = kernel->shape == CS_KERNEL_PARALLELOGRAM && kernel->edges[0][1] == 0 &&
                    kernel->edges[1][0] == 0;
  double count = is_upright ? 1 : ceil(height * kernel->rows / kernel->radius_y);
  if (2 * kernel->radius_x > RAMP)
    count = fmax(count, ceil(across * RAMP / (2 * kernel->radius_x)));
  return count > 1 ? (int)count : 1;
}

/* Kernels whose centres are moved from the pixels' centres. */
typedef struct moved {
  double dx, dy;
  double share; /* the share of these rows in the whole kernel */
} moved;

/* Adds the part of an edge that lies within the heights of moved kernels to these kernels. */
static celspan_status add_cut(cs_scatter *g, const cs_border *edge, const cs_segment *cut,
                              const moved *by) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = count_even_segments(kernel, cut);
  double xa = cut->xa, ya = cut->ya, centre = g->centre + by->dy;
  double above = cs_kernel_above(kernel, ya - centre);
  for (int k = 1; k <= count; k++) {
    double u = (double)k / count;
    double xb = k == count ? cut->xb : cut->xa + u * (cut->xb - cut->xa);
    double yb = k == count ? cut->yb : cut->ya + u * (cut->yb - cut->ya);
    double below = cs_kernel_above(kernel, yb - centre);
    segment t = {.low = (xa < xb ? xa : xb) - by->dx,
                 .high = (xa < xb ? xb : xa) - by->dx,
                 .weight = by->share * (below - above)};
    if (cs_kernel_chord(kernel, 0.5 * (ya + yb) - centre, &t.from, &t.to) &&
        t.to - t.from > NOTHING)
      CS_TRY(add_even_segment(g, edge, &t));
    xa = xb;
    ya = yb;
    above = below;
  }
  return CELSPAN_OK;
}

static celspan_status add_moved(cs_scatter *g, const cs_border *edge, const moved *by) {
  double radius = g->convolve->kernel->radius_y, centre = g->centre + by->dy;
  cs_segment cut;
  return cut_line(&edge->line, centre - radius, centre + radius, &cut) ? add_cut(g, edge, &cut, by)
                                                                       : CELSPAN_OK;
}

static celspan_status scatter_even(cs_scatter *g, const cs_border *edge) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = kernel->offsets;
  if (count <= 1)
    return add_moved(g, edge, &(moved){0, 0, 1});
  for (int j = 0; j < count; j++)
    for (int i = 0; i < count; i++)
      CS_TRY(
          add_moved(g, edge,
                    &(moved){((i + 0.5) / count - 0.5) * kernel->spread,
                             ((j + 0.5) / count - 0.5) * kernel->spread, 1.0 / (count * count)}));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- programs */

static bool are_same(const cs_painter *painter, const cs_program *a, const cs_program *b) {
  if (a->length != b->length || memcmp(a->items, b->items, a->length * sizeof *a->items) != 0)
    return false;
  for (uint32_t i = 0; a->procedure_spans != b->procedure_spans && i < a->length; i++)
    if (painter->stack->layers[a->items[i].layer].kind == CS_LAYER_SCANLINE)
      return false; /* the numbers of procedure spans differ from row to row */
  return true;
}

static celspan_status find_term(cs_scatter *g, const cs_painter *painter, const cs_program *program,
                                uint32_t *out) {
  cs_convolve *convolve = g->convolve;
  for (size_t i = convolve->term_count; i-- > 0;)
    if (are_same(painter, &convolve->terms[i].program, program)) {
      *out = (uint32_t)i;
      return CELSPAN_OK;
    }
  CS_TRY(CS_ARRAY_RESERVE(g->context, convolve->terms, convolve->term_count + 1));
  convolve->terms[convolve->term_count] = (cs_convolve_term){.program = *program};
  *out = (uint32_t)convolve->term_count++;
  return CELSPAN_OK;
}

/* Finds the terms of the row's cells that vary. */
static celspan_status find_terms(cs_scatter *g, cs_painter *painter) {
  const cs_retained_row *retained = g->retained;
  g->terms = NULL;
  if (retained->item_count == 0)
    return CELSPAN_OK;
  cs_arena_reset(&painter->scratch);
  g->terms = cs_arena_take(g->context, &painter->scratch, retained->cell_count * sizeof *g->terms);
  if (!g->terms)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < retained->cell_count; i++)
    if (retained->cells[i].length > 0) {
      const cs_program program = cs_retained_program(retained, &retained->cells[i]);
      CS_TRY(find_term(g, painter, &program, &g->terms[i]));
    }
  return CELSPAN_OK;
}

static celspan_status add_row(cs_scatter *g, cs_painter *painter) {
  const cs_retained_row *retained = g->retained;
  CS_TRY(find_terms(g, painter));
  for (size_t i = 0; i < retained->edge_count; i++)
    CS_TRY(g->convolve->kernel->shape == CS_KERNEL_SEPARABLE
               ? scatter_separable(g, &retained->edges[i])
               : scatter_even(g, &retained->edges[i]));
  return CELSPAN_OK;
}

celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                               const cs_retained_row *const *retained_rows, size_t count,
                               int32_t y) {
  cs_scatter g = {.convolve = convolve, .context = painter->context, .centre = y + 0.5};
  convolve->term_count = convolve->shift_count = convolve->passed_count = 0;
  memset(convolve->touched, 0, cs_convolve_words(convolve->width) * sizeof *convolve->touched);
  touch(convolve, 0);
  for (size_t i = 0; i < count; i++) {
    g.retained = retained_rows[i];
    g.row = (uint32_t)i;
    CS_TRY(add_row(&g, painter));
  }
  return CELSPAN_OK;
}
