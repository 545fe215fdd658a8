/* Where arcs are at a height; and whether a plane is one picture: at some heights, each place
 * between two arcs must have one fill. Where several pictures are added up, such as the exposures
 * of a frame, places have several. What lies along the sides of the frame has no arcs, and is
 * examined by cs_sides_put.
 */
#include <math.h>

#include "inside/sort.h"
#include "writers/parcels/making.h"

enum { HEIGHTS = 32, HEIGHTS_MOST = 288, ROOT_STEPS = 40 };
#define NEAR 4e-6 /* share of the width: arcs that are nearer are at one place */

/* An arc at a height, and where. */
typedef struct cs_passing {
  double x;
  uint32_t arc;
} cs_passing;

static inline bool is_before(const cs_passing *a, const cs_passing *b) {
  return a->x != b->x ? a->x < b->x : a->arc < b->arc;
}
CS_SORT_DEFINE(sort_passings, cs_passing, is_before)

static celspan_point at(const celspan_point p[4], double t) {
  const double s = 1 - t, a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
  return (celspan_point){a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                         a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
}

double cs_curve_share(const cs_parcel_curve *curve, double y) {
  const celspan_point *p = curve->points;
  double low = 0, high = 1;
  if (curve->is_line)
    return p[3].y > p[0].y ? (y - p[0].y) / (p[3].y - p[0].y) : 0;
  for (int i = 0; i < ROOT_STEPS; i++) {
    double middle = (low + high) / 2;
    if (at(p, middle).y < y)
      low = middle;
    else
      high = middle;
  }
  return low;
}

double cs_arc_x(const cs_parcels *parcels, uint32_t arc, double y) {
  const cs_parcel_curve *curve = &parcels->curves[parcels->arcs[arc].curve];
  const cs_parcel_curve *last = curve + parcels->arcs[arc].curve_count - 1;
  while (curve < last && curve->points[3].y <= y)
    curve++;
  const celspan_point *p = curve->points;
  const double t = cs_curve_share(curve, y);
  return curve->is_line ? p[0].x + t * (p[3].x - p[0].x) : at(p, t).x;
}

/* Lists the arcs at a height, from left to right. share: of the frame's height. out: room for all
 * arcs. Returns how many there are. */
static size_t list_passings(const cs_parcels *parcels, double share, cs_passing *out) {
  const double units = share * PLANEFILE_SIDE;
  size_t count = 0;
  for (uint32_t i = 0; i < parcels->arc_count; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[i];
    if (arc->top <= units && arc->foot > units)
      out[count++] = (cs_passing){cs_arc_x(parcels, i, share * parcels->height), i};
  }
  sort_passings(out, count);
  return count;
}

/* counts: of each fill, all 0 before and after. */
static bool is_single(const cs_parcels *parcels, const cs_passing *all, size_t count,
                      int32_t *counts) {
  size_t open = 1;
  bool single = true;
  counts[0] = 1;
  for (size_t i = 0; i < count; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[all[i].arc];
    open -= counts[arc->left] == 1;
    open += --counts[arc->left] == -1;
    open -= counts[arc->right] == -1;
    open += ++counts[arc->right] == 1;
    if (i + 1 == count || all[i + 1].x - all[i].x > NEAR * parcels->width)
      single &= open == 1;
  }
  for (size_t i = 0; i < count; i++)
    counts[parcels->arcs[all[i].arc].left] = counts[parcels->arcs[all[i].arc].right] = 0;
  counts[0] = 0;
  return single;
}

/* What heights are examined with. */
typedef struct examining {
  const cs_parcels *parcels;
  cs_passing *all;
  int32_t *counts;
  double shares[HEIGHTS_MOST]; /* the heights so far, as shares of the frame's */
  size_t count;
} examining;

static bool examine(examining *e, double share) {
  e->shares[e->count++] = share;
  return is_single(e->parcels, e->all, list_passings(e->parcels, share, e->all), e->counts);
}

/* Whether a height so far meets the arc, or the arc is no taller than the plane's rounding. */
static bool is_met(const examining *e, const cs_parcel_arc *arc) {
  bool met = arc->foot - arc->top <= cs_parcels_apart(e->parcels);
  for (size_t i = 0; i < e->count && !met; i++)
    met = e->shares[i] * PLANEFILE_SIDE >= arc->top && e->shares[i] * PLANEFILE_SIDE < arc->foot;
  return met;
}

/* Examines some heights, and then the middles of arcs between them, as of a small disc. */
static bool are_single(examining *e) {
  for (int i = 0; i < HEIGHTS; i++)
    if (!examine(e, (i + 0.4321) / HEIGHTS))
      return false;
  for (uint32_t i = 0; i < e->parcels->arc_count && e->count < HEIGHTS_MOST; i++) {
    const cs_parcel_arc *arc = &e->parcels->arcs[i];
    if (!is_met(e, arc) && !examine(e, ((double)arc->top + arc->foot) / 2 / PLANEFILE_SIDE))
      return false;
  }
  return true;
}

celspan_status cs_parcels_refuse_sums(celspan_context *context, const cs_parcels *parcels) {
  examining e = {.parcels = parcels};
  CS_TRY(CS_MAKE(context, e.counts, parcels->fill_count));
  celspan_status status = CS_MAKE(context, e.all, parcels->arc_count + 1);
  if (status == CELSPAN_OK && (parcels->is_sum || !are_single(&e)))
    status = cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "the plane is a sum of several pictures, as motion blur is, and has no areas");
  cs_mem_free(context->memory, e.all, (parcels->arc_count + 1) * sizeof *e.all);
  cs_mem_free(context->memory, e.counts, parcels->fill_count * sizeof *e.counts);
  return status;
}
