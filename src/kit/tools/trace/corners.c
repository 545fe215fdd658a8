#include "tools/trace/corners.h"

#include <math.h>

#include "inside/number.h"
#include "tools/trace/stretches.h"

/* The number of points on either side of doubtful ones that are examined with them. */
enum { MARGIN = 24 };
/* The most points between two stretches that meet in a corner. */
enum { GAP_MOST = 4 };
/* The greatest distance of a corner from the points around it. */
#define FAR 2.5
/* The greatest distance of points from an arc without a corner, in units of the noise. */
#define DOUBT 1.4

/* The number of points on either side of a bend that cannot be distinguished from a corner, and the
 * least radius of the bend in pixels. */
enum { ROUND = 5 };
#define ROUND_LEAST 2.0

typedef struct finder {
  celspan_context *context;
  const cs_points *points;
  bool is_closed;
  const cs_fit_rules *rules;
  cs_stretches stretches; /* the stretches of the range that is examined */
  cs_corner_list *out;
} finder;

static ptrdiff_t point_count(const finder *f) { return (ptrdiff_t)f->points->count; }

/* Only one point in this many is examined, because the surroundings of neighbours overlap by
 * far. */
static int stride_of(const finder *f) { return f->rules->near / 2; }

/* Whether a single arc goes through the points around a point. */
static bool is_smooth(const finder *f, ptrdiff_t i) {
  ptrdiff_t count = point_count(f), from = i - f->rules->near, to = i + f->rules->near + 1;
  if (!f->is_closed) {
    from = from < 0 ? 0 : from;
    to = to > count ? count : to;
  }
  cs_arc_sums sums = cs_arc_begin(cs_points_at(f->points, i));
  for (ptrdiff_t k = from; k < to && k - from < count; k++)
    cs_arc_add(&sums, cs_points_at(f->points, k));
  double most = DOUBT * f->rules->noise;
  return cs_arc_line_error(&sums) <= most * most || cs_arc_error(&sums) <= most * most;
}

/* ---------------------------------------------------------------- one corner */

/* Moves to the intersection of both; false: there is none, or it is too far away. */
static bool intersect(const cs_arc *a, const cs_arc *b, celspan_point *point) {
  celspan_point begun = *point, u, v;
  for (int step = 0; step < 5; step++) {
    double off_a = cs_arc_off(a, *point, &u), off_b = cs_arc_off(b, *point, &v);
    double area = u.x * v.y - u.y * v.x;
    if (fabs(area) < 0.05)
      return false;
    point->x -= (off_a * v.y - off_b * u.y) / area;
    point->y -= (off_b * u.x - off_a * v.x) / area;
    double dx = point->x - begun.x, dy = point->y - begun.y;
    if (dx * dx + dy * dy > FAR * FAR)
      return false;
  }
  return true;
}

/* The direction of a stretch at a point, seen from another of its points. step: 1 towards the
 * point, -1 away from it. */
static celspan_point direction_at(const cs_arc *arc, celspan_point point, celspan_point seen,
                                  int step) {
  celspan_point across;
  (void)cs_arc_off(arc, point, &across);
  double length = cs_number_length(across.x, across.y);
  celspan_point along = {-across.y / length, across.x / length};
  double ahead = along.x * (point.x - seen.x) + along.y * (point.y - seen.y);
  double sign = ahead * step < 0 ? -1 : 1;
  return (celspan_point){sign * along.x, sign * along.y};
}

/* Whether two consecutive stretches meet in a corner. */
static bool meet(const finder *f, const cs_stretch *a, const cs_stretch *b, celspan_point *point) {
  celspan_point last = cs_points_at(f->points, a->to - 1), first = cs_points_at(f->points, b->from);
  *point = (celspan_point){0.5 * (last.x + first.x), 0.5 * (last.y + first.y)};
  if (b->from - a->to > GAP_MOST || !intersect(&a->arc, &b->arc, point))
    return false;
  celspan_point in = direction_at(&a->arc, *point, cs_points_at(f->points, a->to - 2), 1);
  celspan_point out = direction_at(&b->arc, *point, cs_points_at(f->points, b->from + 1), -1);
  return in.x * out.x + in.y * out.y <= f->rules->turn;
}

/* Whether the points between two stretches, and next to them, are near to both sides of their
 * corner, within rounding. Along a bend they are not. */
static bool is_filled(const finder *f, const cs_stretch *a, const cs_stretch *b) {
  for (ptrdiff_t i = a->to - 1; i <= b->from; i++) {
    celspan_point own = cs_points_at(f->points, i), across;
    double off_a = fabs(cs_arc_off(&a->arc, own, &across));
    double off_b = fabs(cs_arc_off(&b->arc, own, &across));
    if (off_a > f->rules->rounding && off_b > f->rules->rounding)
      return false;
  }
  return true;
}

/* Whether an arc passes through the gates around the joint of two stretches, one of which is an
 * arc: if so, a continued bend is as likely as a corner. */
static bool goes_round(const finder *f, const cs_stretch *a, const cs_stretch *b) {
  ptrdiff_t middle = (a->to + b->from) / 2, from = middle - ROUND, to = middle + ROUND;
  cs_gate_row row;
  cs_street street;
  if (!f->rules->is_exact || (a->arc.bend == 0 && b->arc.bend == 0))
    return false;
  if (!f->is_closed) {
    from = from < 1 ? 1 : from;
    to = to > point_count(f) - 1 ? point_count(f) - 1 : to;
  }
  cs_stretches_row(f->points, from, to, &row);
  return row.count >= CS_STRETCH_FEWEST && cs_street_find(&row, false, &street) &&
         fabs(street.middle.bend) < 0.5 / ROUND_LEAST;
}

/* The nearest of the points [from, to). */
static size_t nearest(const finder *f, celspan_point point, ptrdiff_t from, ptrdiff_t to) {
  ptrdiff_t best = from, count = point_count(f);
  double least = HUGE_VAL;
  for (ptrdiff_t i = from; i < to; i++) {
    celspan_point own = cs_points_at(f->points, i);
    double dx = own.x - point.x, dy = own.y - point.y, far = dx * dx + dy * dy;
    if (far < least) {
      least = far;
      best = i;
    }
  }
  return (size_t)(((best % count) + count) % count);
}

static celspan_status add(const finder *f, size_t at, celspan_point point) {
  cs_corner_list *out = f->out;
  if (out->count > 0 && out->items[out->count - 1].at == at)
    return CELSPAN_OK;
  return CS_APPEND(f->context, out->items, out->count, out->capacity, (cs_corner){at, point});
}

/* ---------------------------------------------------------------- ranges */

/* The corners at points [from, to), found with `margin` points on either side. */
static celspan_status find_between(finder *f, ptrdiff_t from, ptrdiff_t to, ptrdiff_t margin) {
  ptrdiff_t begin = from - margin, end = to + margin, count = point_count(f);
  if (!f->is_closed) {
    begin = begin < 0 ? 0 : begin;
    end = end > count ? count : end;
  }
  CS_TRY(f->rules->is_exact ? cs_stretches_thread(f->context, f->points, begin, end, &f->stretches)
                            : cs_stretches_find(f->context, f->points, begin, end, f->rules->noise,
                                                &f->stretches));
  for (size_t i = 0; i + 1 < f->stretches.count; i++) {
    const cs_stretch *a = &f->stretches.items[i], *b = a + 1;
    celspan_point point;
    if (a->to < from || a->to >= to || !is_filled(f, a, b) || !meet(f, a, b, &point) ||
        goes_round(f, a, b))
      continue;
    CS_TRY(add(f, nearest(f, point, a->to - 1, b->from + 1), point));
  }
  return CELSPAN_OK;
}

/* A point around which all points within the margin are smooth; the number of points if there is
 * none. */
static ptrdiff_t find_smooth(const finder *f) {
  ptrdiff_t count = point_count(f), run = 0, stride = stride_of(f);
  for (ptrdiff_t i = 0; i < count; i += stride) {
    run = is_smooth(f, i) ? run + stride : 0;
    if (run > 2 * MARGIN)
      return i - MARGIN;
  }
  return count;
}

/* Searches from `begin` on, once around or to the end: doubtful points that are near each other are
 * examined together. */
static celspan_status find_all(finder *f, ptrdiff_t begin) {
  ptrdiff_t end = begin + point_count(f), stride = stride_of(f);
  for (ptrdiff_t i = begin; i < end; i += stride) {
    if (is_smooth(f, i))
      continue;
    ptrdiff_t last = i;
    for (ptrdiff_t k = i; k < end && k - last <= MARGIN; k += stride)
      last = is_smooth(f, k) ? last : k;
    ptrdiff_t from = i - f->rules->near, to = last + f->rules->near + 1;
    CS_TRY(find_between(f, from > begin ? from : begin, to < end ? to : end, MARGIN));
    i = to;
  }
  return CELSPAN_OK;
}

static celspan_status find(finder *f) {
  ptrdiff_t count = point_count(f);
  if (!f->is_closed)
    return find_all(f, 0);
  ptrdiff_t begin = find_smooth(f);
  return begin < count ? find_all(f, begin)
                       : find_between(f, 0, count, count < MARGIN ? count : MARGIN);
}

celspan_status cs_corners_find(celspan_context *context, const cs_points *points, bool is_closed,
                               const cs_fit_rules *rules, cs_corner_list *out) {
  finder f = {context, points, is_closed, rules, {.items = NULL}, out};
  celspan_status status = points->count > 0 ? find(&f) : CELSPAN_OK;
  cs_stretches_finish(context, &f.stretches);
  return status;
}

void cs_corners_finish(celspan_context *context, cs_corner_list *corners) {
  cs_mem_free(context->memory, corners->items, corners->capacity * sizeof *corners->items);
  *corners = (cs_corner_list){.items = NULL};
}
