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
#include "kernel/scatter.h"

#include "base/number.h"

#include <math.h>

#define NARROW 1e-4  /* of a chord: segments that cross less count as upright */
#define NOTHING 1e-9 /* shorter chords have no weight worth adding */
#define RAMP 8       /* columns; under longer chords, segments that cross little are ramps */

/* A segment of an edge, and the share of the kernel at its heights. */
typedef struct segment {
  double low, high; /* x */
  double from, to;  /* the kernel's chord at its middle height, relative to the kernel's centre */
  double weight;
  int32_t first, end; /* columns whose kernel it divides; from `end` on the kernel has passed it */
} segment;

static double half_square(double v) { return v > 0 ? 0.5 * v * v : 0; }

/* The share of the chord of a kernel with centre c that lies right of a segment, as a mean over the
 * segment's heights. scale: 1 / the chord's length, divided by the width of the segment unless that
 * is upright. */
static double share_right(const segment *t, double c, bool is_upright, double scale) {
  if (is_upright)
    return cs_number_clamp((c + t->to - 0.5 * (t->low + t->high)) * scale, 0, 1);
  return (half_square(c + t->to - t->low) - half_square(c + t->from - t->low) -
          half_square(c + t->to - t->high) + half_square(c + t->from - t->high)) *
         scale;
}

/* Adds a segment to each column whose kernel it divides, and as a whole to the columns after. */
static celspan_status spread(cs_scatter *g, const cs_retained_edge *edge, const segment *t) {
  cs_convolve *convolve = g->convolve;
  double before = 0, length = t->to - t->from, across = t->high - t->low;
  bool is_upright = across < NARROW * length, is_flat = cs_scatter_is_flat(edge);
  double scale = 1 / (is_upright ? length : length * across);
  cs_v4 step = (float)t->weight * (edge->right.colour - edge->left.colour);
  int32_t stop = t->end < convolve->width ? t->end : convolve->width;
  for (int32_t p = t->first > 0 ? t->first : 0; p < stop; p++) {
    double now = share_right(t, p + 0.5, is_upright, scale);
    cs_scatter_touch(convolve, p);
    convolve->values[p] += (float)now * step;
    if (!is_flat)
      CS_TRY(cs_scatter_shift(g, edge, p, t->weight * (now - before)));
    before = now;
  }
  if (t->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = t->end > 0 ? t->end : 0;
  cs_scatter_touch(convolve, rest);
  cs_scatter_step(g, edge, rest, t->weight);
  return cs_scatter_shift(g, edge, rest, t->weight * (1 - before));
}

static void tilt(cs_scatter *g, const cs_retained_edge *edge, int32_t p, double slope) {
  double *sum = g->convolve->slopes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += slope * ((double)edge->right.colour[c] - (double)edge->left.colour[c]);
}

/* An upright segment between flat colours under a chord is a ramp: one change where it begins, one
 * where it ends. */
static void spread_ramp(cs_scatter *g, const cs_retained_edge *edge, const segment *t) {
  cs_convolve *convolve = g->convolve;
  double x = 0.5 * (t->low + t->high), slope = 1 / (t->to - t->from);
  int32_t first = cs_number_first_centre(x - t->to), end = cs_number_first_centre(x - t->from);
  first = first > 0 ? first : 0;
  if (first >= convolve->width)
    return;
  double now = end > first ? (first + 0.5 + t->to - x) * slope : 1;
  cs_scatter_touch(convolve, first);
  cs_scatter_step(g, edge, first, t->weight * now);
  if (end <= first)
    return;
  tilt(g, edge, first, t->weight * slope);
  if (end >= convolve->width)
    return;
  cs_scatter_touch(convolve, end);
  tilt(g, edge, end, -t->weight * slope);
  cs_scatter_step(g, edge, end, t->weight * (1 - (now + (end - first) * slope)));
}

static celspan_status add_segment(cs_scatter *g, const cs_retained_edge *edge, segment *t) {
  if (t->weight == 0)
    return CELSPAN_OK;
  t->first = cs_number_first_centre(t->low - t->to);
  t->end = cs_number_first_centre(t->high - t->from);
  bool is_ramp = t->end - t->first > RAMP && t->high - t->low <= (t->to - t->from) / RAMP &&
                 cs_scatter_is_flat(edge);
  if (!is_ramp)
    return spread(g, edge, t);
  spread_ramp(g, edge, t);
  return CELSPAN_OK;
}

/* Into how many segments an edge is cut so that the kernel has nearly one chord over the heights of
 * each; an upright box has the same chord at all heights. */
static int count_segments(const cs_kernel *kernel, const cs_retained_edge *edge) {
  double height = edge->yb - edge->ya, across = fabs(edge->xb - edge->xa);
  bool is_upright = kernel->shape == CS_KERNEL_PARALLELOGRAM && kernel->edges[0][1] == 0 &&
                    kernel->edges[1][0] == 0;
  double count = is_upright ? 1 : ceil(height * kernel->rows / kernel->radius_y);
  if (2 * kernel->radius_x > RAMP)
    count = fmax(count, ceil(across * RAMP / (2 * kernel->radius_x)));
  return count > 1 ? (int)count : 1;
}

/* Adds an edge, cut to the heights of the kernel, to kernels whose centres are moved by dx, dy from
 * the pixels' centres. share: of these kernels in the whole one. */
static celspan_status add_cut(cs_scatter *g, const cs_retained_edge *edge, double dx, double dy,
                              double share) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = count_segments(kernel, edge);
  double xa = edge->xa, ya = edge->ya, centre = g->centre + dy;
  double above = cs_kernel_above(kernel, ya - centre);
  for (int k = 1; k <= count; k++) {
    double u = (double)k / count;
    double xb = k == count ? edge->xb : edge->xa + u * (edge->xb - edge->xa);
    double yb = k == count ? edge->yb : edge->ya + u * (edge->yb - edge->ya);
    double below = cs_kernel_above(kernel, yb - centre);
    segment t = {.low = (xa < xb ? xa : xb) - dx,
                 .high = (xa < xb ? xb : xa) - dx,
                 .weight = share * (below - above)};
    if (cs_kernel_chord(kernel, 0.5 * (ya + yb) - centre, &t.from, &t.to) &&
        t.to - t.from > NOTHING)
      CS_TRY(add_segment(g, edge, &t));
    xa = xb;
    ya = yb;
    above = below;
  }
  return CELSPAN_OK;
}

static celspan_status add_offset(cs_scatter *g, const cs_retained_edge *edge, double dx, double dy,
                                 double share) {
  double radius = g->convolve->kernel->radius_y, centre = g->centre + dy;
  cs_retained_edge cut;
  return cs_scatter_cut(edge, centre - radius, centre + radius, &cut)
             ? add_cut(g, &cut, dx, dy, share)
             : CELSPAN_OK;
}

celspan_status cs_scatter_even(cs_scatter *g, const cs_retained_edge *edge) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = kernel->offsets;
  if (count <= 1)
    return add_offset(g, edge, 0, 0, 1);
  for (int j = 0; j < count; j++)
    for (int i = 0; i < count; i++)
      CS_TRY(add_offset(g, edge, ((i + 0.5) / count - 0.5) * kernel->spread,
                        ((j + 0.5) / count - 0.5) * kernel->spread, 1.0 / (count * count)));
  return CELSPAN_OK;
}
