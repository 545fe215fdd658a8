/* Joints: where three arcs or more meet, their ends become one point.
 *
 *        1 |  2      a plane rounds the height of an end. Where an arc is nearly flat, this moves
 *     .----+----     its end far beyond the arcs that it ends at: the areas of its sides overlap
 *        3 |  3      with the one behind them
 *
 * Ends are moved along their height alone, so that all walks remain closed.
 */
#include <math.h>

#include "writers/parcels/making.h"

enum { ROOT_STEPS = 8 };
#define FAR 0.5 /* the share of a curve that is cut off or continued, at most */

/* The ends of arcs have numbers: 2 times the arc, plus 1 for the foot. Those that meet are a tree:
 * each leads to another one, and the last of them to itself. */
typedef struct tree_end {
  uint32_t next;
  uint32_t count; /* the count of the last one: how many ends lead to it */
  double extent;  /* how far the plane's rounding may have moved it along its height */
} tree_end;

typedef struct joining {
  cs_parcels *parcels;
  tree_end *ends;
} joining;

static uint32_t end_number(cs_parcel_walk walk, bool is_end) {
  return 2 * walk.arc + (walk.is_up != is_end);
}

static cs_parcel_curve *curve_at(const cs_parcels *parcels, uint32_t end) {
  const cs_parcel_arc *arc = &parcels->arcs[end / 2];
  return &parcels->curves[arc->curve + (end & 1 ? arc->curve_count - 1 : 0)];
}

static celspan_point point_at(const cs_parcels *parcels, uint32_t end) {
  return curve_at(parcels, end)->points[end & 1 ? 3 : 0];
}

/* The rounding moves an end within a box about it, and along its arc by the height of the box. */
static double extent_of(const cs_parcels *parcels, uint32_t end) {
  const celspan_point box = cs_parcels_near(parcels), at = point_at(parcels, end);
  const double other = point_at(parcels, end ^ 1).y;
  const double y = end & 1 ? fmax(at.y - box.y, other) : fmin(at.y + box.y, other);
  return box.x + fabs(cs_arc_x(parcels, end / 2, y) - at.x);
}

/* ---------------------------------------------------------------- which ends meet */

static uint32_t last_of(tree_end *ends, uint32_t end) {
  while (ends[end].next != end)
    end = ends[end].next = ends[ends[end].next].next;
  return end;
}

/* Two ends that a walk joins meet if the extent of either is enough. The last of a tree is the end
 * of the least extent: its place is the most certain. */
static void meet(const joining *j, uint32_t a, uint32_t b) {
  const double gap = fabs(point_at(j->parcels, a).x - point_at(j->parcels, b).x);
  if (gap > fmax(j->ends[a].extent, j->ends[b].extent))
    return;
  a = last_of(j->ends, a);
  b = last_of(j->ends, b);
  if (a == b)
    return;
  const bool is_a = j->ends[a].extent < j->ends[b].extent;
  tree_end *last = &j->ends[is_a ? a : b], *other = &j->ends[is_a ? b : a];
  last->count += other->count;
  other->next = last->next;
}

static void meet_along(const joining *j, const cs_parcel_loop *loop) {
  const cs_parcel_walk *walks = &j->parcels->walks[loop->walk];
  for (size_t i = 0; i < loop->walk_count; i++)
    meet(j, end_number(walks[i], true), end_number(walks[(i + 1) % loop->walk_count], false));
}

/* ---------------------------------------------------------------- moves */

static double mix(double a, double b, double t) { return a + t * (b - a); }

/* The share at which a curve comes to x, or would if it continued before its begin. */
static double share_at(const celspan_point p[4], double x) {
  double t = 0;
  for (int i = 0; i < ROOT_STEPS; i++) {
    const double a = mix(p[0].x, p[1].x, t), b = mix(p[1].x, p[2].x, t), c = mix(p[2].x, p[3].x, t);
    const double first = mix(a, b, t), second = mix(b, c, t);
    t -= (mix(first, second, t) - x) / (3 * (second - first));
  }
  return t;
}

/* Moves the begin of a curve along itself as far as it can, so that it keeps its shape. */
static void move_begin(celspan_point p[4], double x) {
  const double y = p[0].y, t = share_at(p, x);
  for (int level = 1; level < 4 && fabs(t) <= FAR; level++)
    for (int i = 0; i + level < 4; i++)
      p[i] = (celspan_point){mix(p[i].x, p[i + 1].x, t), mix(p[i].y, p[i + 1].y, t)};
  p[0] = (celspan_point){x, y};
}

static void move_end(const cs_parcels *parcels, uint32_t end, double x) {
  cs_parcel_curve *curve = curve_at(parcels, end);
  celspan_point turned[4];
  for (int i = 0; i < 4; i++)
    turned[i] = curve->points[end & 1 ? 3 - i : i];
  if (curve->is_line)
    turned[0].x = turned[1].x = x;
  else if (turned[0].x != x)
    move_begin(turned, x);
  for (int i = 0; i < 4; i++)
    curve->points[end & 1 ? 3 - i : i] = turned[i];
}

celspan_status cs_joints_make(celspan_context *context, cs_parcels *parcels) {
  const uint32_t count = 2 * (uint32_t)parcels->arc_count;
  joining j = {.parcels = parcels};
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, j.ends, count));
  for (uint32_t i = 0; i < count; i++)
    j.ends[i] = (tree_end){i, 1, extent_of(parcels, i)};
  for (size_t i = 0; i < parcels->loop_count; i++)
    meet_along(&j, &parcels->loops[i]);
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t last = last_of(j.ends, i);
    if (j.ends[last].count > 2)
      move_end(parcels, i, point_at(parcels, last).x);
  }
  cs_mem_free(context->memory, j.ends, count * sizeof *j.ends);
  return CELSPAN_OK;
}
