/* Whether a plane is one picture: at some heights, each place between two arcs must have one fill.
 * Where several pictures are added up, such as the exposures of a frame, places have several. */
#include <math.h>

#include "base/sort.h"
#include "frames/parcels/making.h"

enum { HEIGHTS = 32, ROOT_STEPS = 40 };
#define NEAR 4e-6 /* of the width: arcs that are nearer than this are at one place */

typedef struct passing {
  double x;
  uint32_t left, right;
} passing;

static inline bool is_before(const passing *a, const passing *b) { return a->x < b->x; }
CS_SORT_DEFINE(sort_passings, passing, is_before)

static celspan_point at(const celspan_point p[4], double t) {
  const double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
  return (celspan_point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                         a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
}

static double find_x(const cs_parcels *parcels, const cs_parcel_arc *arc, double y) {
  const cs_parcel_curve *curve = &parcels->curves[arc->curve];
  const cs_parcel_curve *last = curve + arc->curve_count - 1;
  double low = 0, high = 1;
  while (curve < last && curve->points[3].y <= y)
    curve++;
  const celspan_point *p = curve->points;
  if (curve->is_line)
    return p[3].y > p[0].y ? p[0].x + (y - p[0].y) / (p[3].y - p[0].y) * (p[3].x - p[0].x) : p[0].x;
  for (int i = 0; i < ROOT_STEPS; i++) {
    double middle = (low + high) / 2;
    if (at(p, middle).y < y)
      low = middle;
    else
      high = middle;
  }
  return at(p, low).x;
}

/* counts: of each fill, all 0 before and after. */
static bool is_single(const cs_parcels *parcels, const passing *all, size_t count,
                      int32_t *counts) {
  size_t open = 1;
  bool single = true;
  counts[0] = 1;
  for (size_t i = 0; i < count; i++) {
    open -= counts[all[i].left] == 1;
    open += --counts[all[i].left] == -1;
    open -= counts[all[i].right] == -1;
    open += ++counts[all[i].right] == 1;
    if (i + 1 == count || all[i + 1].x - all[i].x > NEAR * parcels->width)
      single &= open == 1;
  }
  for (size_t i = 0; i < count; i++)
    counts[all[i].left] = counts[all[i].right] = 0;
  counts[0] = 0;
  return single;
}

static bool are_single(const cs_parcels *parcels, passing *all, int32_t *counts) {
  for (int i = 0; i < HEIGHTS; i++) {
    double share = (i + 0.4321) / HEIGHTS, units = share * PLANEFILE_SIDE;
    size_t count = 0;
    for (size_t k = 0; k < parcels->arc_count; k++) {
      const cs_parcel_arc *arc = &parcels->arcs[k];
      if (arc->top <= units && arc->foot > units)
        all[count++] =
            (passing){find_x(parcels, arc, share * parcels->height), arc->left, arc->right};
    }
    sort_passings(all, count);
    if (!is_single(parcels, all, count, counts))
      return false;
  }
  return true;
}

celspan_status cs_parcels_refuse_sums(celspan_context *context, const cs_parcels *parcels) {
  passing *all = NULL;
  int32_t *counts;
  CS_TRY(CS_MAKE(context, counts, parcels->fill_count));
  celspan_status status = CS_MAKE(context, all, parcels->arc_count + 1);
  if (status == CELSPAN_OK && !are_single(parcels, all, counts))
    status = cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "the plane is a sum of several pictures, as motion blur is, and has no areas");
  cs_mem_free(context->memory, all, (parcels->arc_count + 1) * sizeof *all);
  cs_mem_free(context->memory, counts, parcels->fill_count * sizeof *counts);
  return status;
}
