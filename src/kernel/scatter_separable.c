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
#include "kernel/scatter.h"

#include "base/number.h"

#include <math.h>

#define STRETCH 1.0 /* columns that segments summed together may cross */
#define WIDEST 0.25 /* columns that one segment may cross */

/* Into how many segments an edge is cut: the error of a segment grows as the product of its height
 * and its width. */
static int count_segments(const cs_kernel *kernel, double height, double across) {
  double wanted = kernel->rows * kernel->sharpness * sqrt(height * across);
  double least = across * kernel->sharpness / WIDEST;
  return (int)ceil(fmax(wanted, fmax(least, 1)));
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
  double column = floor(x - 0.5), phase = (x - 0.5 - column) * kernel->phases;
  /* Just left of a centre, phase rounds to `phases`. */
  int32_t row = cs_number_row(phase, kernel->phases), stride = kernel->stride;
  float t = (float)(phase - row);
  const float *low = kernel->shares + (size_t)row * (size_t)stride, *high = low + stride;
  float *out = sums + ((int32_t)column - kernel->columns - s->first);
  cs_v4 near = cs_v4_all(weight * (1 - t)), far = cs_v4_all(weight * t);
  for (int32_t k = 0; k < stride; k += 4)
    cs_v4_store(out + k,
                cs_v4_load(out + k) + (near * cs_v4_load(low + k) + far * cs_v4_load(high + k)));
  for (float *rest = out + stride; rest < sums + (s->end - s->first); rest++)
    *rest += weight;
}

/* The first sub-row of the retained row whose middle is at or below height y. */
static int first_sub_row(const cs_scatter *g, double y) {
  double sub_row = ceil((y - g->retained->row) * CS_CONVOLVE_SUB_ROWS - 0.5);
  return (int)cs_number_clamp(sub_row, 0, CS_CONVOLVE_SUB_ROWS);
}

/* Notes that from column p on the kernel has passed the heights y0..y1 of an edge. */
static celspan_status add_passed(cs_scatter *g, const cs_retained_edge *edge, int32_t p, double y0,
                                 double y1) {
  cs_convolve *convolve = g->convolve;
  int sub_row = first_sub_row(g, y0), sub_row_end = first_sub_row(g, y1);
  if (sub_row == sub_row_end)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(g->context, (void **)&convolve->passed, &convolve->passed_capacity,
                        convolve->passed_count + 1, sizeof *convolve->passed));
  cs_convolve_passed *passed = &convolve->passed[convolve->passed_count++];
  *passed = (cs_convolve_passed){.next = convolve->passed_at[p],
                                 .row = g->row,
                                 .sub_row = sub_row,
                                 .sub_row_end = sub_row_end,
                                 .varies = (edge->right.program >= 0) - (edge->left.program >= 0)};
  passed->step = cs_v4d_step(edge->left.colour, edge->right.colour);
  convolve->passed_at[p] = (uint32_t)convolve->passed_count;
  return CELSPAN_OK;
}

static cs_convolve_range range_of(const cs_retained_edge *edge) {
  cs_convolve_range range = cs_convolve_nothing();
  if (edge->left.program < 0)
    cs_convolve_widen(&range, edge->left.colour);
  if (edge->right.program < 0)
    cs_convolve_widen(&range, edge->right.colour);
  return range;
}

/* Adds the colour step of a stretch to its columns, by the sums of its segments. */
static celspan_status put_stretch(cs_scatter *g, const cs_retained_edge *edge, const stretch *s,
                                  const float *sums) {
  cs_convolve *convolve = g->convolve;
  cs_v4 step = edge->right.colour - edge->left.colour;
  int32_t first = s->first > 0 ? s->first : 0;
  int32_t end = s->end < convolve->width ? s->end : convolve->width;
  bool is_flat = cs_scatter_is_flat(edge);
  double before = 0;
  for (int32_t p = first; p < end; p++) {
    float share = sums[p - s->first];
    cs_scatter_touch(convolve, p);
    convolve->values[p] += share * step;
    if (!is_flat)
      CS_TRY(cs_scatter_shift(g, edge, p, (double)share - before));
    before = (double)share;
  }
  if (convolve->kernel->is_signed) {
    cs_convolve_range range = range_of(edge);
    for (int32_t p = first; p < end; p++)
      convolve->near[p] = cs_convolve_both(convolve->near[p], range);
  }
  if (s->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = s->end > 0 ? s->end : 0;
  cs_scatter_touch(convolve, rest);
  cs_scatter_step(g, edge, rest, s->weight);
  return cs_scatter_shift(g, edge, rest, s->weight - before);
}

/* Adds the stretch `cut` of an edge, in `count` segments that are summed together. */
static celspan_status add_stretch(cs_scatter *g, const cs_retained_edge *edge,
                                  const cs_retained_edge *cut, int count) {
  const cs_kernel *kernel = g->convolve->kernel;
  float *sums = g->convolve->sums;
  double low = fmin(cut->xa, cut->xb) - 0.5, high = fmax(cut->xa, cut->xb) - 0.5;
  double above = cs_kernel_above(kernel, cut->ya - g->centre), begin = above;
  stretch s = {(int32_t)floor(low) - kernel->columns, (int32_t)floor(high) + kernel->columns + 2,
               0};
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

celspan_status cs_scatter_separable(cs_scatter *g, const cs_retained_edge *edge) {
  const cs_kernel *kernel = g->convolve->kernel;
  cs_retained_edge within, cut;
  if (!cs_scatter_cut(edge, g->centre - kernel->radius_y, g->centre + kernel->radius_y, &within))
    return CELSPAN_OK;
  double height = within.yb - within.ya, across = within.xb - within.xa;
  int stretches = (int)ceil(fmax(fabs(across) / STRETCH, 1));
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
