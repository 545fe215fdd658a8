/* A piece under an even shape: at each height the kernel is one interval in which it is constant.
 */
#include "kernel/scatter.h"

#include "base/number.h"

#include <math.h>

#define NARROW 1e-4  /* of the interval: pieces that cross less stand upright */
#define NOTHING 1e-9 /* slices that are shorter have no weight to speak of */
#define RAMP 8       /* columns; longer slices are ramps to pieces that cross little of them */

/* A part of a piece, and the share of the kernel at its heights. */
typedef struct part {
  double low, high; /* x */
  double from, to;  /* the kernel at its heights, about the centre of a pixel */
  double weight;
  int32_t first, end; /* columns that it parts; from `end` on it is passed */
} part;

static celspan_status change(cs_scatter *g, const cs_retained_edge *piece, int32_t p,
                             double weight) {
  cs_scatter_step(g, piece, p, weight);
  return cs_scatter_shift(g, piece, p, weight);
}

static double half_square(double v) { return v > 0 ? 0.5 * v * v : 0; }

/* The share of the kernel's slice about c that lies right of the part. scale: 1 / its length, and
 * 1 / what the part crosses unless it stands upright. */
static double share_right(const part *t, double c, bool is_upright, double scale) {
  if (is_upright)
    return cs_number_clamp((c + t->to - 0.5 * (t->low + t->high)) * scale, 0, 1);
  return (half_square(c + t->to - t->low) - half_square(c + t->from - t->low) -
          half_square(c + t->to - t->high) + half_square(c + t->from - t->high)) *
         scale;
}

static celspan_status spread(cs_scatter *g, const cs_retained_edge *piece, const part *t) {
  cs_convolve *convolve = g->convolve;
  double before = 0, length = t->to - t->from, across = t->high - t->low;
  bool is_upright = across < NARROW * length, is_flat = cs_scatter_is_flat(piece);
  double scale = 1 / (is_upright ? length : length * across);
  cs_v4 step = (float)t->weight * (piece->right.colour - piece->left.colour);
  int32_t stop = t->end < convolve->width ? t->end : convolve->width;
  for (int32_t p = t->first > 0 ? t->first : 0; p < stop; p++) {
    double now = share_right(t, p + 0.5, is_upright, scale);
    cs_scatter_touch(convolve, p);
    convolve->values[p] += (float)now * step;
    if (!is_flat)
      CS_TRY(cs_scatter_shift(g, piece, p, t->weight * (now - before)));
    before = now;
  }
  if (t->end >= convolve->width)
    return CELSPAN_OK;
  int32_t rest = t->end > 0 ? t->end : 0;
  cs_scatter_touch(convolve, rest);
  cs_scatter_step(g, piece, rest, t->weight);
  return cs_scatter_shift(g, piece, rest, t->weight * (1 - before));
}

static void tilt(cs_scatter *g, const cs_retained_edge *piece, int32_t p, double slope) {
  double *sum = g->convolve->slopes[p];
  for (int c = 0; c < 4; c++)
    sum[c] += slope * ((double)piece->right.colour[c] - (double)piece->left.colour[c]);
}

/* An upright edge under an even slice is a ramp: one change where it begins, one where it ends. */
static celspan_status spread_ramp(cs_scatter *g, const cs_retained_edge *piece, const part *t) {
  cs_convolve *convolve = g->convolve;
  double x = 0.5 * (t->low + t->high), slope = 1 / (t->to - t->from);
  int32_t first = cs_number_first_centre(x - t->to), end = cs_number_first_centre(x - t->from);
  first = first > 0 ? first : 0;
  if (first >= convolve->width)
    return CELSPAN_OK;
  double now = end > first ? (first + 0.5 + t->to - x) * slope : 1;
  cs_scatter_touch(convolve, first);
  CS_TRY(change(g, piece, first, t->weight * now));
  if (end <= first)
    return CELSPAN_OK;
  tilt(g, piece, first, t->weight * slope);
  if (end >= convolve->width)
    return CELSPAN_OK;
  cs_scatter_touch(convolve, end);
  tilt(g, piece, end, -t->weight * slope);
  return change(g, piece, end, t->weight * (1 - (now + (end - first) * slope)));
}

static celspan_status add_part(cs_scatter *g, const cs_retained_edge *piece, part *t) {
  if (t->weight == 0)
    return CELSPAN_OK;
  t->first = cs_number_first_centre(t->low - t->to);
  t->end = cs_number_first_centre(t->high - t->from);
  bool is_ramp = t->end - t->first > RAMP && t->high - t->low <= (t->to - t->from) / RAMP &&
                 cs_scatter_is_flat(piece);
  return is_ramp ? spread_ramp(g, piece, t) : spread(g, piece, t);
}

/* In how many parts the kernel is even enough over a piece's heights: an upright box always is. */
static int count_parts(const cs_kernel *kernel, const cs_retained_edge *piece) {
  double height = piece->yb - piece->ya, across = fabs(piece->xb - piece->xa);
  bool is_upright = kernel->shape == CS_KERNEL_PARALLELOGRAM && kernel->edges[0][1] == 0 &&
                    kernel->edges[1][0] == 0;
  double parts = is_upright ? 1 : ceil(height * kernel->rows / kernel->radius_y);
  if (2 * kernel->radius_x > RAMP)
    parts = fmax(parts, ceil(across * RAMP / (2 * kernel->radius_x)));
  return parts > 1 ? (int)parts : 1;
}

/* A piece as a kernel `dx`, `dy` from the pixel's centre sees it, of `share` of the whole. */
static celspan_status add_cut(cs_scatter *g, const cs_retained_edge *piece, double dx, double dy,
                              double share) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = count_parts(kernel, piece);
  double xa = piece->xa, ya = piece->ya, centre = g->centre + dy;
  double above = cs_kernel_above(kernel, ya - centre);
  for (int k = 1; k <= count; k++) {
    double u = (double)k / count;
    double xb = k == count ? piece->xb : piece->xa + u * (piece->xb - piece->xa);
    double yb = k == count ? piece->yb : piece->ya + u * (piece->yb - piece->ya);
    double below = cs_kernel_above(kernel, yb - centre);
    part t = {.low = (xa < xb ? xa : xb) - dx,
              .high = (xa < xb ? xb : xa) - dx,
              .weight = share * (below - above)};
    if (cs_kernel_slice(kernel, 0.5 * (ya + yb) - centre, &t.from, &t.to) &&
        t.to - t.from > NOTHING)
      CS_TRY(add_part(g, piece, &t));
    xa = xb;
    ya = yb;
    above = below;
  }
  return CELSPAN_OK;
}

static celspan_status add_seen(cs_scatter *g, const cs_retained_edge *piece, double dx, double dy,
                               double share) {
  double radius = g->convolve->kernel->radius_y, centre = g->centre + dy;
  cs_retained_edge cut;
  return cs_scatter_cut(piece, centre - radius, centre + radius, &cut)
             ? add_cut(g, &cut, dx, dy, share)
             : CELSPAN_OK;
}

celspan_status cs_scatter_even(cs_scatter *g, const cs_retained_edge *piece) {
  const cs_kernel *kernel = g->convolve->kernel;
  int count = kernel->offsets;
  if (count <= 1)
    return add_seen(g, piece, 0, 0, 1);
  for (int j = 0; j < count; j++)
    for (int i = 0; i < count; i++)
      CS_TRY(add_seen(g, piece, ((i + 0.5) / count - 0.5) * kernel->spread,
                      ((j + 0.5) / count - 0.5) * kernel->spread, 1.0 / (count * count)));
  return CELSPAN_OK;
}
