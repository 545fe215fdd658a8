#include "tools/trace/cubic.h"

#include <math.h>

#include "common/solve.h"
#include "inside/number.h"

/* How often the parameters are moved towards the curve, and the most points that are examined for
 * this. */
enum { ROUNDS = 4, ASKED = 40 };
/* A cubic whose error is this many times the allowed error cannot become good enough. */
#define HOPELESS 6.0
/* The same for gates, where the weights must be found, too; and the share of its weight that a
 * point keeps if the curve goes exactly through it. */
enum { THREAD_ROUNDS = 12 };
#define THREAD_HOPELESS 20.0
#define STAYS 0.05

typedef struct cubic {
  celspan_point p[4];
} cubic;

static celspan_point point_at(const cubic *c, double t) {
  double s = 1 - t, b0 = s * s * s, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
  return (celspan_point){b0 * c->p[0].x + b1 * c->p[1].x + b2 * c->p[2].x + b3 * c->p[3].x,
                         b0 * c->p[0].y + b1 * c->p[1].y + b2 * c->p[2].y + b3 * c->p[3].y};
}

static celspan_point slope_at(const cubic *c, double t) {
  double s = 1 - t, b0 = 3 * s * s, b1 = 6 * s * t, b2 = 3 * t * t;
  return (celspan_point){
      b0 * (c->p[1].x - c->p[0].x) + b1 * (c->p[2].x - c->p[1].x) + b2 * (c->p[3].x - c->p[2].x),
      b0 * (c->p[1].y - c->p[0].y) + b1 * (c->p[2].y - c->p[1].y) + b2 * (c->p[3].y - c->p[2].y)};
}

static celspan_point bend_at(const cubic *c, double t) {
  double s = 1 - t;
  const celspan_point *p = c->p;
  return (celspan_point){
      6 * (s * (p[2].x - 2 * p[1].x + p[0].x) + t * (p[3].x - 2 * p[2].x + p[1].x)),
      6 * (s * (p[2].y - 2 * p[1].y + p[0].y) + t * (p[3].y - 2 * p[2].y + p[1].y))};
}

/* ---------------------------------------------------------------- parameters */

static void begin_stations(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                           cs_cubic_station *stations) {
  double sum = 0;
  celspan_point from = ends[0].point;
  for (size_t i = 0; i < count; i++) {
    celspan_point at = points[i].at;
    sum += cs_number_length(at.x - from.x, at.y - from.y);
    stations[i] = (cs_cubic_station){sum, 1, 1};
    from = at;
  }
  sum += cs_number_length(ends[1].point.x - from.x, ends[1].point.y - from.y);
  for (size_t i = 0; i < count; i++)
    stations[i].parameter = sum > 0 ? stations[i].parameter / sum : 0;
}

/* One step of Newton's method towards the nearest point of the curve. */
static double nearer(const cubic *c, celspan_point point, double t) {
  celspan_point at = point_at(c, t), slope = slope_at(c, t), bend = bend_at(c, t);
  double dx = at.x - point.x, dy = at.y - point.y;
  double first = dx * slope.x + dy * slope.y;
  double second = slope.x * slope.x + slope.y * slope.y + dx * bend.x + dy * bend.y;
  if (!(second > 1e-12))
    return t;
  t -= first / second;
  return t < 0 ? 0 : t > 1 ? 1 : t;
}

/* ---------------------------------------------------------------- least squares */

/* The unknowns: how far each control point is from its end, along its tangent or along x and y. */
typedef struct unknown {
  int end; /* 0, 1 */
  celspan_point along;
} unknown;

static int list_unknowns(const cs_cubic_end ends[2], unknown list[4]) {
  int count = 0;
  for (int end = 0; end < 2; end++) {
    if (ends[end].has_tangent) {
      list[count++] = (unknown){end, ends[end].tangent};
    } else {
      list[count++] = (unknown){end, {1, 0}};
      list[count++] = (unknown){end, {0, 1}};
    }
  }
  return count;
}

typedef struct sums {
  double b[2][2]; /* sums of products of the weights of both control points */
  /* sums of products of their weights with the part of the points that the ends do not explain */
  celspan_point r[2];
} sums;

static void add_point(sums *s, const cs_cubic_end ends[2], celspan_point point, double t,
                      double weight) {
  double u = 1 - t, w[2] = {3 * u * u * t, 3 * u * t * t};
  double near = u * u * u + w[0], far = t * t * t + w[1];
  double dx = point.x - near * ends[0].point.x - far * ends[1].point.x;
  double dy = point.y - near * ends[0].point.y - far * ends[1].point.y;
  for (int i = 0; i < 2; i++) {
    double own = weight * w[i];
    s->b[i][0] += own * w[0];
    s->b[i][1] += own * w[1];
    s->r[i].x += own * dx;
    s->r[i].y += own * dy;
  }
}

/* Places each control point on the tangent of its end, a third of the way to the other end. */
static void place_plainly(const cs_cubic_end ends[2], celspan_point control[2]) {
  double dx = (ends[1].point.x - ends[0].point.x) / 3, dy = (ends[1].point.y - ends[0].point.y) / 3;
  double third = cs_number_length(dx, dy);
  for (int i = 0; i < 2; i++) {
    double sign = i == 0 ? 1 : -1;
    celspan_point along = {sign * dx, sign * dy};
    if (ends[i].has_tangent)
      along = (celspan_point){third * ends[i].tangent.x, third * ends[i].tangent.y};
    control[i] = (celspan_point){ends[i].point.x + along.x, ends[i].point.y + along.y};
  }
}

/* Whether the control points are plausible for a curve along the points: in front of their ends,
 * and not too far away. */
static bool is_sound(const cs_cubic_end ends[2], const celspan_point control[2]) {
  double chord =
      cs_number_length(ends[1].point.x - ends[0].point.x, ends[1].point.y - ends[0].point.y);
  for (int i = 0; i < 2; i++) {
    double dx = control[i].x - ends[i].point.x, dy = control[i].y - ends[i].point.y;
    if (cs_number_length(dx, dy) > 2 * chord + 1)
      return false;
    if (ends[i].has_tangent && dx * ends[i].tangent.x + dy * ends[i].tangent.y < 0)
      return false;
  }
  return true;
}

static void place_controls(const sums *s, const cs_cubic_end ends[2], celspan_point control[2]) {
  unknown list[4];
  double m[4 * 5], solution[4];
  int count = list_unknowns(ends, list), width = count + 1;
  for (int i = 0; i < count; i++) {
    const unknown *own = &list[i];
    for (int j = 0; j < count; j++)
      m[i * width + j] = s->b[own->end][list[j].end] *
                         (own->along.x * list[j].along.x + own->along.y * list[j].along.y);
    m[i * width + count] = own->along.x * s->r[own->end].x + own->along.y * s->r[own->end].y;
  }
  bool is_solved = cs_solve(m, count, width, 1e-9, solution);
  control[0] = ends[0].point;
  control[1] = ends[1].point;
  for (int i = 0; i < count && is_solved; i++) {
    control[list[i].end].x += solution[i] * list[i].along.x;
    control[list[i].end].y += solution[i] * list[i].along.y;
  }
  if (!is_solved || !is_sound(ends, control))
    place_plainly(ends, control);
}

/* ---------------------------------------------------------------- fitting */

static double far_from(const cubic *c, celspan_point point, double t) {
  celspan_point at = point_at(c, t);
  return cs_number_length(at.x - point.x, at.y - point.y);
}

/* The distances of points: the greatest one, and the root mean square. */
typedef struct distances {
  double most, mean;
} distances;

/* Moves the parameters towards the curve, and returns the distances after this. step: one point in
 * `step` is examined. */
static distances bring_nearer(const cubic *c, const cs_edge_point *points, size_t count,
                              size_t step, cs_cubic_station *stations) {
  double most = 0, squares = 0, asked = 0;
  for (size_t i = 0; i < count; i += step) {
    double t = nearer(c, points[i].at, stations[i].parameter);
    double far = far_from(c, points[i].at, t);
    stations[i].parameter = t;
    most = far > most ? far : most;
    squares += far * far;
    asked++;
  }
  return (distances){most, sqrt(squares / asked)};
}

/* The cubic of least squares, with the points at the parameters of their stations. */
static cubic solve(const cs_edge_point *points, size_t count, size_t step,
                   const cs_cubic_end ends[2], const cs_cubic_station *stations,
                   celspan_point control[2]) {
  sums s = {.b = {{0}}};
  for (size_t i = 0; i < count; i += step)
    add_point(&s, ends, points[i].at, stations[i].parameter,
              stations[i].weight / (stations[i].room * stations[i].room));
  place_controls(&s, ends, control);
  return (cubic){{ends[0].point, control[0], control[1], ends[1].point}};
}

bool cs_cubic_fit(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                  double tolerance, double mean, cs_cubic_station *stations,
                  celspan_point control[2]) {
  size_t step = count / ASKED + 1;
  begin_stations(points, count, ends, stations);
  place_plainly(ends, control);
  if (count == 0)
    return true;
  for (int round = 0; round < ROUNDS; round++) {
    const cubic c = solve(points, count, step, ends, stations, control);
    distances off = bring_nearer(&c, points, count, step, stations);
    if (off.most <= tolerance && off.mean <= mean) {
      if (step == 1)
        return true;
      off = bring_nearer(&c, points, count, 1, stations);
      return off.most <= tolerance && off.mean <= mean;
    }
    if (off.most > HOPELESS * tolerance)
      return false;
  }
  return false;
}

/* ---------------------------------------------------------------- through gates */

/* The distance of the curve from a point, as a share of the room in the gate of this point: at 1,
 * the curve just goes through the gate. The distance is measured across the curve, and beyond its
 * ends as the distance from the end. */
static double pass(const cubic *c, const cs_edge_point *point, cs_cubic_station *station) {
  double t = nearer(c, point->at, station->parameter);
  celspan_point at = point_at(c, t), slope = slope_at(c, t);
  double dx = point->at.x - at.x, dy = point->at.y - at.y,
         fast = cs_number_length(slope.x, slope.y);
  bool is_across = fast > 0 && t > 0 && t < 1;
  celspan_point along = {0, 0};
  if (fast > 0)
    along = (celspan_point){slope.x / fast, slope.y / fast};
  station->parameter = t;
  station->room = cs_edge_room(point, along);
  return (is_across ? fabs(dx * along.y - dy * along.x) : cs_number_length(dx, dy)) / station->room;
}

/* Measures how the curve passes all gates, and sets the weights of the points again. Returns the
 * largest share. */
static double pass_all(const cubic *c, const cs_edge_point *points, size_t count,
                       cs_cubic_station *stations) {
  double most = 0, total = 0;
  for (size_t i = 0; i < count; i++) {
    double share = pass(c, &points[i], &stations[i]);
    most = share > most ? share : most;
    stations[i].weight *= share + STAYS;
    total += stations[i].weight;
  }
  for (size_t i = 0; i < count; i++)
    stations[i].weight *= (double)count / total;
  return most;
}

bool cs_cubic_thread(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                     cs_cubic_station *stations, celspan_point control[2]) {
  begin_stations(points, count, ends, stations);
  place_plainly(ends, control);
  if (count == 0)
    return true;
  for (int round = 0; round < THREAD_ROUNDS; round++) {
    const cubic c = solve(points, count, 1, ends, stations, control);
    double most = pass_all(&c, points, count, stations);
    if (most <= 1)
      return true;
    if (most > THREAD_HOPELESS)
      return false;
  }
  return false;
}
