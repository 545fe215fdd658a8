#include "trace/fit.h"

#include <math.h>
#include <string.h>

#include "trace/cubic.h"

/* Points this near to a corner or an end are not fitted: what lies about a corner rounds them. */
#define NEAR 1.1
/* How many points a fit is begun with. */
enum { FIRST = 8 };

/* ---------------------------------------------------------------- pieces */

static double snap(double x) { return floor(x * CS_FIT_GRID + 0.5) / CS_FIT_GRID; }

celspan_point cs_fit_snap(celspan_point point) {
  return (celspan_point){snap(point.x), snap(point.y)};
}

celspan_status cs_pieces_add(celspan_context *context, cs_pieces *pieces, const cs_piece *piece) {
  CS_TRY(cs_mem_reserve(context, (void **)&pieces->items, &pieces->capacity, pieces->count + 1,
                        sizeof *pieces->items));
  pieces->items[pieces->count++] =
      (cs_piece){piece->is_line,
                 {cs_fit_snap(piece->control[0]), cs_fit_snap(piece->control[1])},
                 cs_fit_snap(piece->to)};
  return CELSPAN_OK;
}

celspan_status cs_pieces_draw(celspan_context *context, cs_writing *path, const cs_piece *piece,
                              celspan_point to, bool is_back) {
  if (piece->is_line)
    return cs_writing_draw(context, path, 'L', &to, 1);
  const celspan_point points[3] = {piece->control[is_back], piece->control[!is_back], to};
  return cs_writing_draw(context, path, 'C', points, 3);
}

void cs_pieces_finish(celspan_context *context, cs_pieces *pieces) {
  cs_mem_free(context->memory, pieces->items, pieces->capacity * sizeof *pieces->items);
  *pieces = (cs_pieces){.items = NULL};
}

static celspan_status add_line(celspan_context *context, cs_pieces *out, celspan_point to) {
  const cs_piece line = {.is_line = true, .to = to};
  return cs_pieces_add(context, out, &line);
}

celspan_status cs_fit_lines(celspan_context *context, const cs_points *points, cs_pieces *out) {
  for (size_t i = 1; i < points->count; i++)
    CS_TRY(add_line(context, out, points->items[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a part between two corners */

/* A part: its points, the first and last of which are its ends. */
typedef struct part {
  celspan_context *context;
  const cs_fit_rules *rules;
  cs_points points;
  double *parameters; /* room, for each point */
  bool is_ring;       /* its ends are one joint, not corners */
  cs_pieces *out;
} part;

static double apart(celspan_point a, celspan_point b) {
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/* How far a point is from the line through two others. */
static double off_line(celspan_point from, celspan_point to, celspan_point point) {
  double dx = to.x - from.x, dy = to.y - from.y, length = sqrt(dx * dx + dy * dy);
  if (length < 1e-9)
    return apart(from, point);
  return fabs((point.x - from.x) * dy - (point.y - from.y) * dx) / length;
}

static bool is_straight(const part *p) {
  const celspan_point *items = p->points.items;
  size_t last = p->points.count - 1;
  for (size_t i = 1; i < last; i++)
    if (off_line(items[0], items[last], items[i]) > 0.75 * p->rules->tolerance)
      return false;
  return true;
}

/* Each point becomes the mean of itself and its neighbours; ends stay. */
static void make_even(part *p) {
  celspan_point *items = p->points.items;
  for (int round = 0; round < p->rules->evening; round++) {
    celspan_point before = items[0];
    for (size_t i = 1; i + 1 < p->points.count; i++) {
      celspan_point own = items[i];
      items[i] = (celspan_point){(before.x + 2 * own.x + items[i + 1].x) / 4,
                                 (before.y + 2 * own.y + items[i + 1].y) / 4};
      before = own;
    }
  }
}

static void set_joint(cs_parabola parabola, cs_cubic_end *out) {
  out->point = parabola.point;
  out->tangent = parabola.tangent;
  out->has_tangent = out->tangent.x != 0 || out->tangent.y != 0;
}

/* The joint at a point: the parabola of the points about it. */
static void make_joint(const part *p, size_t i, cs_cubic_end *out) {
  size_t last = p->points.count - 1, about = (size_t)p->rules->about;
  size_t room = i < last - i ? i : last - i;
  size_t extent = room < about ? room : about;
  const cs_stretch_of_points both = {&p->points, (ptrdiff_t)i, 1, -(int)extent,
                                     (int)(2 * extent + 1)};
  set_joint(cs_parabola_at(&both), out);
}

/* The joint of a ring: its points go on before the first and after the last, which are the same. */
static void make_ring_joint(const part *p, cs_cubic_end *out) {
  cs_points once = p->points;
  once.count--;
  int about = p->rules->about;
  if ((size_t)(2 * about + 1) > once.count)
    about = (int)((once.count - 1) / 2);
  const cs_stretch_of_points both = {&once, 0, 1, -about, 2 * about + 1};
  set_joint(cs_parabola_at(&both), out);
}

/* The end of a fit at a point, towards points after it (step 1) or before it (-1). */
static cs_cubic_end end_at(const part *p, size_t i, int step) {
  size_t last = p->points.count - 1;
  cs_cubic_end end = {.point = p->points.items[i]};
  if (i > 0 && i < last)
    make_joint(p, i, &end);
  else if (p->is_ring)
    make_ring_joint(p, &end);
  end.tangent.x *= step;
  end.tangent.y *= step;
  return end;
}

/* Fits the points from one to another. */
static bool fit(const part *p, size_t from, size_t to, cs_piece *out) {
  const cs_cubic_end ends[2] = {end_at(p, from, 1), end_at(p, to, -1)};
  out->is_line = false;
  out->to = ends[1].point;
  return cs_cubic_fit(p->points.items + from + 1, to - from - 1, ends, p->rules->tolerance,
                      p->parameters, out->control);
}

/* The farthest point that one cubic gets to: twice as many points as long as that goes, then halves
 * of what is left. */
static size_t farthest(const part *p, size_t from, cs_piece *best) {
  size_t last = p->points.count - 1, good = from, step = FIRST;
  size_t bad = last + 1;
  cs_piece tried;
  while (good < last && bad > last) {
    size_t to = from + step < last ? from + step : last;
    if (fit(p, from, to, &tried)) {
      good = to;
      *best = tried;
      step *= 2;
    } else {
      bad = to;
    }
  }
  while (bad - good > 1 && good < last) {
    size_t middle = good + (bad - good) / 2;
    if (fit(p, from, middle, &tried)) {
      good = middle;
      *best = tried;
    } else {
      bad = middle;
    }
  }
  return good;
}

/* Goes as far as it gets; at least to the next point, which is a line. */
static celspan_status fit_part(part *p) {
  size_t last = p->points.count - 1;
  if (p->points.count < 3 || (!p->is_ring && is_straight(p)))
    return add_line(p->context, p->out, p->points.items[last]);
  for (size_t from = 0; from < last;) {
    cs_piece best = {.is_line = true, .to = p->points.items[from + 1]};
    size_t to = farthest(p, from, &best);
    CS_TRY(cs_pieces_add(p->context, p->out, &best));
    from = to > from ? to : from + 1;
  }
  return CELSPAN_OK;
}

/* Adds the points between two ends that are far enough from both. */
static celspan_status add_between(part *p, const cs_points *points, size_t from, size_t count,
                                  celspan_point begin, celspan_point end) {
  CS_TRY(cs_points_add(p->context, &p->points, begin));
  for (size_t i = 0; i < count; i++) {
    celspan_point point = points->items[(from + i) % points->count];
    if (apart(point, begin) > NEAR && apart(point, end) > NEAR)
      CS_TRY(cs_points_add(p->context, &p->points, point));
  }
  return cs_points_add(p->context, &p->points, end);
}

static celspan_status run_part(part *p) {
  make_even(p);
  size_t room = p->points.count;
  p->parameters = cs_mem_array(p->context->memory, room, sizeof *p->parameters);
  if (!p->parameters)
    return cs_fail_memory(p->context);
  celspan_status status = fit_part(p);
  cs_mem_free(p->context->memory, p->parameters, room * sizeof *p->parameters);
  return status;
}

/* The part between two ends, of `count` points from `from` on. */
static celspan_status fit_between(const part *like, const cs_points *points, size_t from,
                                  size_t count, const celspan_point ends[2]) {
  part p = *like;
  p.points = (cs_points){.items = NULL};
  celspan_status status = add_between(&p, points, from, count, ends[0], ends[1]);
  if (status == CELSPAN_OK)
    status = run_part(&p);
  cs_points_finish(like->context, &p.points);
  return status;
}

/* ---------------------------------------------------------------- chains */

static void finish_corners(celspan_context *context, cs_corner_list *corners) {
  cs_mem_free(context->memory, corners->items, corners->capacity * sizeof *corners->items);
}

celspan_status cs_fit_open(celspan_context *context, const cs_points *points,
                           const cs_fit_rules *rules, cs_pieces *out) {
  const part p = {.context = context, .rules = rules, .out = out};
  cs_corner_list corners = {.items = NULL};
  size_t last = points->count - 1, from = 0;
  celspan_point ends[2] = {points->items[0], points->items[last]};
  celspan_status status = cs_corners_find(context, points, false, rules, &corners);
  for (size_t i = 0; i < corners.count && status == CELSPAN_OK; i++) {
    const cs_corner *corner = &corners.items[i];
    status = fit_between(&p, points, from + 1, corner->at - from - 1,
                         (celspan_point[]){ends[0], corner->point});
    from = corner->at;
    ends[0] = corner->point;
  }
  if (status == CELSPAN_OK)
    status = fit_between(&p, points, from + 1, last > from ? last - from - 1 : 0, ends);
  finish_corners(context, &corners);
  return status;
}

/* Without corners: one part that comes back to where it began. */
static celspan_status fit_ring(const part *like, const cs_points *points, celspan_point *start) {
  part p = *like;
  cs_cubic_end joint;
  p.is_ring = true;
  p.points = (cs_points){.items = NULL};
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i <= points->count && status == CELSPAN_OK; i++)
    status = cs_points_add(like->context, &p.points, points->items[i % points->count]);
  if (status == CELSPAN_OK) {
    make_ring_joint(&p, &joint);
    *start = cs_fit_snap(joint.point);
    status = run_part(&p);
  }
  cs_points_finish(like->context, &p.points);
  return status;
}

/* From corner to corner around. */
static celspan_status fit_around(const part *p, const cs_points *points,
                                 const cs_corner_list *corners) {
  for (size_t i = 0; i < corners->count; i++) {
    const cs_corner *from = &corners->items[i], *to = &corners->items[(i + 1) % corners->count];
    size_t way = (to->at + points->count - from->at) % points->count;
    way = way == 0 ? points->count : way;
    CS_TRY(
        fit_between(p, points, from->at + 1, way - 1, (celspan_point[]){from->point, to->point}));
  }
  return CELSPAN_OK;
}

celspan_status cs_fit_closed(celspan_context *context, const cs_points *points,
                             const cs_fit_rules *rules, celspan_point *start, cs_pieces *out) {
  const part p = {.context = context, .rules = rules, .out = out};
  cs_corner_list corners = {.items = NULL};
  celspan_status status = cs_corners_find(context, points, true, rules, &corners);
  if (status == CELSPAN_OK && corners.count > 0) {
    *start = cs_fit_snap(corners.items[0].point);
    status = fit_around(&p, points, &corners);
  } else if (status == CELSPAN_OK) {
    status = fit_ring(&p, points, start);
  }
  finish_corners(context, &corners);
  return status;
}
