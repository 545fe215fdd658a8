/* Arcs that lie on each other: where shapes have a part of their outlines in common, a plane has
 * slivers between them, which are no wider than its rounding. Renderers show them, as fine lines.
 *
 *     |    |           |          arcs are cut at corners, and where one that lies on them begins
 *     |\   |           |          or ends; of those that remain, a fill that is left of one and
 *     ||2  |    -->    |   |      right of another one is a sliver, and goes
 *     1||3 |         1 | 3 |
 */
#include <math.h>

#include "inside/sort.h"
#include "writers/parcels/making.h"

enum { VISITS = 3, HEIGHTS = 3, MOST = 16 /* arcs that lie on each other */ };
enum { FULL = 4096 /* places to cut at, before the first look for equal ones */ };
/* How far apart they are at most: units, and steps of the plane's grid. Each of two borders of one
 * shape is rounded by at most half a step; what is wider may have been drawn. */
#define NEAR 16.0
#define STEPS 2.0

#define CORNER 0.05 /* the sine of an angle */

typedef struct cut_place {
  uint32_t arc;
  int32_t height;
} cut_place;

static inline bool is_cut_before(const cut_place *a, const cut_place *b) {
  return a->arc != b->arc ? a->arc < b->arc : a->height < b->height;
}
CS_SORT_DEFINE(sort_cuts, cut_place, is_cut_before)

typedef struct cut_list {
  cut_place *all;
  size_t count, capacity;
  size_t full; /* the count at which those that are there twice go */
} cut_list;

celspan_point cs_parcels_near(const cs_parcels *parcels) {
  return (celspan_point){fmax(NEAR, STEPS * parcels->columns) / PLANEFILE_SIDE * parcels->width,
                         fmax(NEAR, STEPS * parcels->rows) / PLANEFILE_SIDE * parcels->height};
}

/* Whether two arcs lie on each other from a height to another one. A point of either may be
 * anywhere in a box: its width moves an upright border, and its height one that is nearly flat. */
static bool are_near(const cs_parcels *parcels, uint32_t a, uint32_t b, double top, double foot) {
  const double unit = parcels->height / PLANEFILE_SIDE, down = (foot - top) * unit;
  const double across = cs_arc_x(parcels, a, foot * unit) - cs_arc_x(parcels, a, top * unit);
  const celspan_point most = cs_parcels_near(parcels);
  bool near = foot > top;
  for (int i = 0; i < HEIGHTS && near; i++) {
    double y = (top + (foot - top) * (i + 0.5) / HEIGHTS) * unit;
    double gap = fabs(cs_arc_x(parcels, a, y) - cs_arc_x(parcels, b, y));
    near = gap * down <= most.x * down + most.y * fabs(across);
  }
  return near;
}

/* ---------------------------------------------------------------- cuts */

/* Each place is left once. Each one makes an arc more. */
static celspan_status sort_out(celspan_context *context, const cs_parcels *parcels,
                               cut_list *cuts) {
  size_t count = 0;
  sort_cuts(cuts->all, cuts->count);
  for (size_t i = 0; i < cuts->count; i++)
    if (i == 0 || is_cut_before(&cuts->all[count - 1], &cuts->all[i]))
      cuts->all[count++] = cuts->all[i];
  cuts->count = count;
  cuts->full = 2 * count + FULL;
  return parcels->arc_count + count > CS_PARCEL_ARCS ? cs_arc_refuse(context) : CELSPAN_OK;
}

static celspan_status add_cut(const cs_beside *row, cut_list *cuts, uint32_t arc, int32_t height) {
  const cs_parcel_arc *a = &row->parcels->arcs[arc];
  if (height <= a->top || height >= a->foot)
    return CELSPAN_OK;
  if (cuts->count >= cuts->full)
    CS_TRY(sort_out(row->context, row->parcels, cuts));
  return CS_APPEND(row->context, cuts->all, cuts->count, cuts->capacity, (cut_place){arc, height});
}

/* Compares an arc with those beside it, on one side. */
static celspan_status compare_side(const cs_beside *row, size_t place, bool right, cut_list *cuts) {
  const uint32_t arc = row->arcs[place];
  const cs_parcel_arc *a = &row->parcels->arcs[arc];
  for (size_t by = 1; by < MOST && (right ? place + by < row->count : by <= place); by++) {
    const uint32_t other = row->arcs[right ? place + by : place - by];
    const cs_parcel_arc *b = &row->parcels->arcs[other];
    const int32_t top = a->top > b->top ? a->top : b->top;
    const int32_t foot = a->foot < b->foot ? a->foot : b->foot;
    if (!are_near(row->parcels, arc, other, top, foot))
      break;
    CS_TRY(add_cut(row, cuts, arc, top));
    CS_TRY(add_cut(row, cuts, arc, foot));
    CS_TRY(add_cut(row, cuts, other, top));
    CS_TRY(add_cut(row, cuts, other, foot));
  }
  return CELSPAN_OK;
}

static celspan_status compare_arc(const cs_beside *row, size_t place, void *user) {
  CS_TRY(compare_side(row, place, false, user));
  return compare_side(row, place, true, user);
}

/* ---------------------------------------------------------------- parts of arcs */

static celspan_point mix(celspan_point a, celspan_point b, double t) {
  return (celspan_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/* Leaves the part of a curve below a height, and gives the part above it. */
static cs_parcel_curve cut_off(cs_parcel_curve *curve, double y) {
  const double t = cs_curve_share(curve, y);
  celspan_point *p = curve->points;
  cs_parcel_curve above = *curve;
  if (curve->is_line)
    p[0] = p[1] = above.points[2] = above.points[3] = mix(p[0], p[3], t);
  for (int level = 1; level < 4 && !curve->is_line; level++) {
    for (int i = 0; i + level < 4; i++)
      p[i] = mix(p[i], p[i + 1], t);
    above.points[level] = p[0];
  }
  above.points[3].y = p[0].y = y;
  return above;
}

/* Ends an arc that is being copied. */
static celspan_status put_part(celspan_context *context, cs_parcels *parcels, cs_parcel_arc *part,
                               int32_t foot) {
  part->foot = foot;
  part->curve_count = parcels->curve_count - part->curve;
  CS_TRY(CS_ARRAY_APPEND(context, parcels->arcs, parcels->arc_count, *part));
  part->top = foot;
  part->curve = parcels->curve_count;
  return CELSPAN_OK;
}

static celspan_status put_curve(celspan_context *context, cs_parcels *parcels,
                                cs_parcel_curve curve) {
  return CS_ARRAY_APPEND(context, parcels->curves, parcels->curve_count, curve);
}

/* Replaces an arc by its parts; the first one has its place. */
static celspan_status cut_arc(celspan_context *context, cs_parcels *parcels, const cut_place *cuts,
                              size_t count) {
  const cs_parcel_arc whole = parcels->arcs[cuts->arc];
  const size_t first = parcels->arc_count;
  cs_parcel_arc part = whole;
  part.curve = parcels->curve_count;
  for (size_t i = whole.curve, next = 0; i < whole.curve + whole.curve_count; i++) {
    cs_parcel_curve curve = parcels->curves[i];
    for (; next < count; next++) {
      const double y = (double)cuts[next].height / PLANEFILE_SIDE * parcels->height;
      if (y >= curve.points[3].y && i + 1 < whole.curve + whole.curve_count)
        break;
      if (y > curve.points[0].y)
        CS_TRY(put_curve(context, parcels, cut_off(&curve, y)));
      if (parcels->curve_count > part.curve)
        CS_TRY(put_part(context, parcels, &part, cuts[next].height));
    }
    CS_TRY(put_curve(context, parcels, curve));
  }
  CS_TRY(put_part(context, parcels, &part, whole.foot));
  parcels->arcs[cuts->arc] = parcels->arcs[first];
  parcels->arcs[first] = parcels->arcs[--parcels->arc_count];
  return CELSPAN_OK;
}

static celspan_status cut_arcs(celspan_context *context, cs_parcels *parcels, cut_list *cuts) {
  CS_TRY(sort_out(context, parcels, cuts));
  for (size_t i = 0, end; i < cuts->count; i = end) {
    for (end = i + 1; end < cuts->count && cuts->all[end].arc == cuts->all[i].arc; end++) {
    }
    CS_TRY(cut_arc(context, parcels, cuts->all + i, end - i));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- corners */

/* Whether curves meet at an angle. */
static bool is_corner(const cs_parcel_curve *above, const cs_parcel_curve *below) {
  const celspan_point *p = above->points, *q = below->points;
  const int from = above->is_line ? 0 : 2, to = below->is_line ? 3 : 1;
  const double x0 = p[3].x - p[from].x, y0 = p[3].y - p[from].y;
  const double x1 = q[to].x - q[0].x, y1 = q[to].y - q[0].y;
  const double turn = x0 * y1 - x1 * y0;
  return turn * turn > CORNER * CORNER * (x0 * x0 + y0 * y0) * (x1 * x1 + y1 * y1);
}

/* Shapes that have one of their sides in common begin and end at corners. */
static celspan_status cut_corners(celspan_context *context, cs_parcels *parcels) {
  const cs_beside row = {.context = context, .parcels = parcels};
  cut_list cuts = {0};
  celspan_status status = CELSPAN_OK;
  for (uint32_t i = 0; i < parcels->arc_count && status == CELSPAN_OK; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[i];
    for (size_t c = arc->curve; c + 1 < arc->curve + arc->curve_count; c++) {
      const double y = parcels->curves[c].points[3].y;
      const int32_t height = (int32_t)round(y / parcels->height * PLANEFILE_SIDE);
      const bool is_whole = (double)height / PLANEFILE_SIDE * parcels->height == y;
      if (is_whole && is_corner(&parcels->curves[c], &parcels->curves[c + 1]))
        status = add_cut(&row, &cuts, i, height);
    }
  }
  if (status == CELSPAN_OK)
    status = cut_arcs(context, parcels, &cuts);
  cs_mem_free(context->memory, cuts.all, cuts.capacity * sizeof *cuts.all);
  return status;
}

/* ---------------------------------------------------------------- slivers */

typedef struct placed {
  int32_t top, foot;
  double x; /* in the middle */
  uint32_t arc;
} placed;

static inline bool is_before(const placed *a, const placed *b) {
  if (a->top != b->top || a->foot != b->foot)
    return a->top != b->top ? a->top < b->top : a->foot < b->foot;
  return a->x != b->x ? a->x < b->x : a->arc < b->arc;
}
CS_SORT_DEFINE(sort_placed, placed, is_before)

/* All have the curves of the first one. Two with a sliver between them exchange their right sides;
 * one of them then has the sliver on both sides. */
static void join(cs_parcels *parcels, const placed *all, size_t count) {
  for (size_t i = 0; i < count; i++) {
    cs_parcel_arc *a = &parcels->arcs[all[i].arc];
    a->curve = parcels->arcs[all[0].arc].curve;
    a->curve_count = parcels->arcs[all[0].arc].curve_count;
    for (size_t k = 0; k < count; k++) {
      cs_parcel_arc *b = &parcels->arcs[all[k].arc];
      if (i != k && a->left == b->right && a->left != a->right && b->left != b->right) {
        b->right = a->right;
        a->right = a->left;
      }
    }
  }
}

static void join_all(cs_parcels *parcels, placed *all) {
  const size_t count = parcels->arc_count;
  for (uint32_t i = 0; i < count; i++) {
    const cs_parcel_arc *arc = &parcels->arcs[i];
    const double y = ((double)arc->top + arc->foot) / 2 / PLANEFILE_SIDE * parcels->height;
    all[i] = (placed){arc->top, arc->foot, cs_arc_x(parcels, i, y), i};
  }
  sort_placed(all, count);
  for (size_t i = 0, end; i < count; i = end) {
    for (end = i + 1; end < count && end - i < MOST; end++)
      if (all[end].top != all[i].top || all[end].foot != all[i].foot ||
          !are_near(parcels, all[i].arc, all[end].arc, all[i].top, all[i].foot))
        break;
    join(parcels, all + i, end - i);
  }
}

/* Loops have horizontal lines without an arc of no height. */
static void drop_needless(cs_parcels *parcels) {
  size_t count = 0;
  for (size_t i = 0; i < parcels->arc_count; i++)
    if (parcels->arcs[i].left != parcels->arcs[i].right &&
        parcels->arcs[i].top < parcels->arcs[i].foot)
      parcels->arcs[count++] = parcels->arcs[i];
  parcels->arc_count = count;
}

celspan_status cs_parcels_join_slivers(celspan_context *context, cs_parcels *parcels) {
  cut_list cuts = {0};
  placed *all;
  drop_needless(parcels);
  celspan_status status = cut_corners(context, parcels);
  if (status == CELSPAN_OK)
    status = cs_beside_walk(context, parcels, VISITS, compare_arc, &cuts);
  if (status == CELSPAN_OK)
    status = cut_arcs(context, parcels, &cuts);
  cs_mem_free(context->memory, cuts.all, cuts.capacity * sizeof *cuts.all);
  const size_t count = parcels->arc_count;
  if (status != CELSPAN_OK || count == 0)
    return status;
  CS_TRY(CS_MAKE(context, all, count));
  join_all(parcels, all);
  drop_needless(parcels);
  cs_mem_free(context->memory, all, count * sizeof *all);
  return CELSPAN_OK;
}
