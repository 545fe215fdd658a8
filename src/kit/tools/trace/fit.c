#include "tools/trace/fit.h"

#include <math.h>
#include <string.h>

#include "inside/number.h"
#include "tools/trace/cubic.h"
#include "tools/trace/stretches.h"

/* Points nearer than this to a corner or an end are not fitted: the pixels there make a corner
 * round. */
#define NEAR 1.1
/* The number of points with which a fit begins. */
enum { FIRST = 8 };

/* ---------------------------------------------------------------- pieces */

static double snap(double x) { return floor(x * CS_FIT_GRID + 0.5) / CS_FIT_GRID; }

celspan_point cs_fit_snap(celspan_point point) {
  return (celspan_point){snap(point.x), snap(point.y)};
}

celspan_status cs_pieces_add(celspan_context *context, cs_fit_pieces *pieces,
                             const cs_piece *piece) {
  return CS_APPEND(context, pieces->items, pieces->count, pieces->capacity,
                   (cs_piece){piece->is_line,
                              {cs_fit_snap(piece->control[0]), cs_fit_snap(piece->control[1])},
                              cs_fit_snap(piece->to)});
}

celspan_status cs_pieces_draw(celspan_context *context, cs_writing *path, const cs_piece *piece,
                              celspan_point to, bool is_back) {
  if (piece->is_line)
    return cs_writing_draw(context, path, 'L', &to, 1);
  const celspan_point points[3] = {piece->control[is_back], piece->control[!is_back], to};
  return cs_writing_draw(context, path, 'C', points, 3);
}

void cs_pieces_finish(celspan_context *context, cs_fit_pieces *pieces) {
  cs_mem_free(context->memory, pieces->items, pieces->capacity * sizeof *pieces->items);
  *pieces = (cs_fit_pieces){.items = NULL};
}

static celspan_status add_line(celspan_context *context, cs_fit_pieces *out, celspan_point to) {
  const cs_piece line = {.is_line = true, .to = to};
  return cs_pieces_add(context, out, &line);
}

celspan_status cs_fit_lines(celspan_context *context, const cs_points *points, cs_fit_pieces *out) {
  for (size_t i = 1; i < points->count; i++)
    CS_TRY(add_line(context, out, points->items[i].at));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a part between two corners */

/* A part: its points, the first and last of which are its ends. */
typedef struct part {
  celspan_context *context;
  const cs_fit_rules *rules;
  cs_points points;
  CS_ARRAY(cs_cubic_station, stations); /* room, for each point */
  CS_ARRAY(size_t, ends);               /* the points at which pieces end; room for all points */
  size_t end_count;
  bool is_ring; /* both ends are the same joint, which is not a corner */
  cs_fit_pieces *out;
} part;

static double apart(celspan_point a, celspan_point b) {
  return cs_number_length(a.x - b.x, a.y - b.y);
}

/* The distance of a point from the line through two others. */
static double off_line(celspan_point from, celspan_point to, celspan_point point) {
  double dx = to.x - from.x, dy = to.y - from.y, length = cs_number_length(dx, dy);
  if (length < 1e-9)
    return apart(from, point);
  return fabs((point.x - from.x) * dy - (point.y - from.y) * dx) / length;
}

static bool is_straight(const part *p) {
  const cs_edge_point *items = p->points.items;
  size_t last = p->points.count - 1;
  celspan_point from = items[0].at, to = items[last].at;
  double far = apart(from, to);
  celspan_point along = far > 0 ? (celspan_point){(to.x - from.x) / far, (to.y - from.y) / far}
                                : (celspan_point){0, 0};
  for (size_t i = 1; i < last; i++) {
    double most = p->rules->is_exact ? cs_edge_room(&items[i], along) : p->rules->straight;
    if (off_line(from, to, items[i].at) > most)
      return false;
  }
  return true;
}

/* The points around a point: `extent` on either side, or the same number in all, next to an end of
 * the part. */
static cs_arc_sums sum_about(const part *p, ptrdiff_t i, ptrdiff_t extent) {
  ptrdiff_t end = (ptrdiff_t)p->points.count, wanted = 2 * extent + 1;
  cs_points once = p->points;
  once.count -= p->is_ring;
  ptrdiff_t from = i - extent;
  if (!p->is_ring) {
    from = from + wanted > end ? end - wanted : from;
    from = from < 0 ? 0 : from;
    wanted = wanted < end - from ? wanted : end - from;
  }
  cs_arc_sums sums = cs_arc_begin(p->points.items[i].at);
  for (ptrdiff_t k = 0; k < wanted && k < (ptrdiff_t)once.count; k++)
    cs_arc_add(&sums, cs_points_at(&once, from + k));
  return sums;
}

/* Whether the points fit a line as well as an arc. */
static bool is_line(const part *p, const cs_arc_sums *sums) {
  double scale = 0.5 * sums->count / (p->rules->noise * p->rules->noise);
  return sums->count < 4 || scale * (cs_arc_line_error(sums) - cs_arc_error(sums)) <= 3;
}

/* The longest arc around a point whose distance from its points is within the noise. */
static cs_arc arc_about(const part *p, size_t i) {
  double most = p->rules->noise;
  cs_arc_sums sums;
  for (int extent = p->rules->about; extent > 1; extent--) {
    sums = sum_about(p, (ptrdiff_t)i, extent);
    if (cs_arc_error(&sums) <= most * most)
      break;
  }
  return cs_arc_of(&sums, is_line(p, &sums));
}

/* The longest arc that passes the gates about a point; false: none does. */
static bool pass_about(const part *p, size_t i, cs_arc *arc) {
  ptrdiff_t at = (ptrdiff_t)i, last = (ptrdiff_t)p->points.count - 1;
  cs_points once = p->points;
  once.count -= p->is_ring;
  for (ptrdiff_t extent = p->rules->about; extent > 1; extent--) {
    ptrdiff_t from = at - extent, to = at + extent + 1;
    cs_gate_row row;
    cs_street street;
    if (!p->is_ring) {
      from = from < 1 ? 1 : from;
      to = to > last ? last : to;
    }
    cs_stretches_row(&once, from, to, &row);
    if (row.count >= CS_STRETCH_FEWEST && cs_street_find(&row, false, &street)) {
      *arc = street.middle;
      return true;
    }
  }
  return false;
}

/* The joint at a point: it lies on the arc around the point. */
static void make_joint(const part *p, size_t i, cs_cubic_end *out) {
  const cs_edge_point *items = p->points.items;
  size_t last = p->points.count - 1;
  celspan_point before = items[i > 0 ? i - 1 : last - 1].at, after = items[i < last ? i + 1 : 1].at;
  celspan_point across;
  cs_arc arc;
  if (!p->rules->is_exact || !pass_about(p, i, &arc))
    arc = arc_about(p, i);
  out->point = cs_arc_nearest(&arc, items[i].at);
  (void)cs_arc_off(&arc, out->point, &across);
  double length = cs_number_length(across.x, across.y);
  bool is_back = across.x * (after.y - before.y) - across.y * (after.x - before.x) < 0;
  length = is_back ? -length : length;
  out->tangent = (celspan_point){-across.y / length, across.x / length};
  out->has_tangent = true;
}

/* The end of a fit at a point, in the direction of the points after it (step 1) or before it
 * (-1). */
static cs_cubic_end end_at(const part *p, size_t i, int step) {
  size_t last = p->points.count - 1;
  cs_cubic_end end = {.point = p->points.items[i].at};
  if (p->is_ring || (i > 0 && i < last))
    make_joint(p, i, &end);
  end.tangent.x *= step;
  end.tangent.y *= step;
  return end;
}

/* Fits the points between two points: the curve begins at the first and ends at the second. */
static bool fit(const part *p, const cs_cubic_end *begin, size_t from, size_t to, cs_piece *out) {
  const cs_cubic_end ends[2] = {*begin, end_at(p, to, -1)};
  out->is_line = false;
  out->to = ends[1].point;
  const cs_edge_point *points = p->points.items + from + 1;
  size_t count = to - from - 1;
  return p->rules->is_exact ? cs_cubic_thread(points, count, ends, p->stations, out->control)
                            : cs_cubic_fit(points, count, ends, p->rules->tolerance, p->rules->mean,
                                           p->stations, out->control);
}

/* The farthest point that a single cubic can reach: the number of points is doubled as long as
 * possible, then the remaining range is halved. */
static size_t farthest(const part *p, size_t from, cs_piece *best) {
  size_t last = p->points.count - 1, good = from, step = FIRST;
  size_t bad = last + 1;
  const cs_cubic_end begin = end_at(p, from, 1);
  cs_piece tried;
  while (good < last && bad > last) {
    size_t to = from + step < last ? from + step : last;
    if (fit(p, &begin, from, to, &tried)) {
      good = to;
      *best = tried;
      step *= 2;
    } else {
      bad = to;
    }
  }
  while (bad - good > 1 && good < last) {
    size_t middle = good + (bad - good) / 2;
    if (fit(p, &begin, from, middle, &tried)) {
      good = middle;
      *best = tried;
    } else {
      bad = middle;
    }
  }
  return good;
}

/* Each piece goes as far as possible; at least to the next point, as a line. Sets the points at
 * which pieces end. */
static celspan_status fit_greedily(part *p) {
  size_t last = p->points.count - 1;
  for (size_t from = 0; from < last;) {
    cs_piece best = {.is_line = true, .to = p->points.items[from + 1].at};
    size_t to = farthest(p, from, &best);
    CS_TRY(cs_pieces_add(p->context, p->out, &best));
    from = to > from ? to : from + 1;
    p->ends[p->end_count++] = from;
  }
  return CELSPAN_OK;
}

/* Adds the pieces again, each shortened by this share. Sets whether all of them fit. */
static celspan_status fit_shares(const part *p, double share, bool *fits) {
  size_t from = 0;
  *fits = true;
  for (size_t i = 0; i < p->end_count && *fits; i++) {
    bool is_last = i + 1 == p->end_count;
    size_t to = is_last ? p->points.count - 1 : (size_t)(share * (double)p->ends[i] + 0.5);
    const cs_cubic_end begin = end_at(p, from, 1);
    cs_piece piece;
    *fits = to > from && fit(p, &begin, from, to, &piece);
    if (*fits)
      CS_TRY(cs_pieces_add(p->context, p->out, &piece));
    from = to;
  }
  return CELSPAN_OK;
}

/* The longest pieces have the greatest error, and the last piece is often short. Therefore all
 * pieces are shortened to about the same length; if this does not fit, they keep their lengths. */
static celspan_status fit_part(part *p) {
  size_t first = p->out->count, count;
  CS_TRY(CS_ARRAY_MAKE(p->context, p->stations, p->points.count));
  CS_TRY(CS_ARRAY_MAKE(p->context, p->ends, p->points.count));
  CS_TRY(fit_greedily(p));
  count = p->end_count;
  if (count < 2)
    return CELSPAN_OK;
  bool fits;
  double whole = (double)p->ends[count - 2] * (double)count / (double)(count - 1);
  double share = (double)(p->points.count - 1) / whole;
  if (share >= 1)
    return CELSPAN_OK;
  CS_TRY(fit_shares(p, share, &fits));
  cs_piece *pieces = p->out->items + first;
  if (fits)
    memcpy(pieces, pieces + count, count * sizeof *pieces);
  p->out->count = first + count;
  return CELSPAN_OK;
}

/* Adds the points between two ends that are far enough from both. */
static celspan_status add_between(part *p, const cs_points *points, size_t from, size_t count,
                                  celspan_point begin, celspan_point end) {
  CS_TRY(cs_points_add(p->context, &p->points, begin));
  for (size_t i = 0; i < count; i++) {
    const cs_edge_point *point = &points->items[(from + i) % points->count];
    if (apart(point->at, begin) > NEAR && apart(point->at, end) > NEAR)
      CS_TRY(cs_points_copy(p->context, &p->points, point));
  }
  return cs_points_add(p->context, &p->points, end);
}

static celspan_status run_part(part *p) {
  if (p->points.count < 3 || (!p->is_ring && is_straight(p)))
    return add_line(p->context, p->out, p->points.items[p->points.count - 1].at);
  celspan_status status = fit_part(p);
  CS_ARRAYS_FREE(p->context->memory, p, stations, ends);
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

celspan_status cs_fit_open(celspan_context *context, const cs_points *points,
                           const cs_fit_rules *rules, cs_fit_pieces *out) {
  const part p = {.context = context, .rules = rules, .out = out};
  cs_corner_list corners = {.items = NULL};
  size_t last = points->count - 1, from = 0;
  celspan_point ends[2] = {points->items[0].at, points->items[last].at};
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
  cs_corners_finish(context, &corners);
  return status;
}

/* A closed contour without corners: one part that returns to its beginning. */
static celspan_status fit_ring(const part *like, const cs_points *points, celspan_point *start) {
  part p = *like;
  cs_cubic_end joint;
  p.is_ring = true;
  p.points = (cs_points){.items = NULL};
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i <= points->count && status == CELSPAN_OK; i++)
    status = cs_points_copy(like->context, &p.points, &points->items[i % points->count]);
  if (status == CELSPAN_OK) {
    make_joint(&p, 0, &joint);
    *start = cs_fit_snap(joint.point);
    status = run_part(&p);
  }
  cs_points_finish(like->context, &p.points);
  return status;
}

/* Fits the parts from corner to corner, once around. */
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
                             const cs_fit_rules *rules, celspan_point *start, cs_fit_pieces *out) {
  const part p = {.context = context, .rules = rules, .out = out};
  cs_corner_list corners = {.items = NULL};
  celspan_status status = cs_corners_find(context, points, true, rules, &corners);
  if (status == CELSPAN_OK && corners.count > 0) {
    *start = cs_fit_snap(corners.items[0].point);
    status = fit_around(&p, points, &corners);
  } else if (status == CELSPAN_OK) {
    status = fit_ring(&p, points, start);
  }
  cs_corners_finish(context, &corners);
  return status;
}
