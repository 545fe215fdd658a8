#include "trace/cubic.h"

#include <math.h>

#include "base/number.h"

/* Times that parameters are brought to the curve; points that are asked in doing so, at most. */
enum { ROUNDS = 4, ASKED = 40 };
/* What is so many times as far away as is allowed will not come near. */
#define HOPELESS 6.0

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

static void begin_parameters(const celspan_point *points, size_t count, const cs_cubic_end ends[2],
                             double *parameters) {
  double sum = 0;
  celspan_point from = ends[0].point;
  for (size_t i = 0; i < count; i++) {
    sum += cs_number_length(points[i].x - from.x, points[i].y - from.y);
    parameters[i] = sum;
    from = points[i];
  }
  sum += cs_number_length(ends[1].point.x - from.x, ends[1].point.y - from.y);
  for (size_t i = 0; i < count; i++)
    parameters[i] = sum > 0 ? parameters[i] / sum : 0;
}

/* One step of Newton's method towards the nearest place. */
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

/* Solves m x = v by elimination, the largest pivots first; false where it cannot be solved. */
static bool solve(double m[4][5], int n) {
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      best = fabs(m[i][k]) > fabs(m[best][k]) ? i : best;
    if (fabs(m[best][k]) < 1e-9)
      return false;
    for (int j = 0; j <= n; j++) {
      double kept = m[k][j];
      m[k][j] = m[best][j];
      m[best][j] = kept;
    }
    for (int i = 0; i < n; i++) {
      double factor = i == k ? 0 : m[i][k] / m[k][k];
      for (int j = k; j <= n; j++)
        m[i][j] -= factor * m[k][j];
    }
  }
  for (int k = 0; k < n; k++)
    m[k][n] /= m[k][k];
  return true;
}

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
  double b[2][2];     /* of products of the weights of both control points */
  celspan_point r[2]; /* of their weights with what the ends leave over */
} sums;

static void add_point(sums *s, const cs_cubic_end ends[2], celspan_point point, double t) {
  double u = 1 - t, w[2] = {3 * u * u * t, 3 * u * t * t};
  double near = u * u * u + w[0], far = t * t * t + w[1];
  double dx = point.x - near * ends[0].point.x - far * ends[1].point.x;
  double dy = point.y - near * ends[0].point.y - far * ends[1].point.y;
  for (int i = 0; i < 2; i++) {
    s->b[i][0] += w[i] * w[0];
    s->b[i][1] += w[i] * w[1];
    s->r[i].x += w[i] * dx;
    s->r[i].y += w[i] * dy;
  }
}

/* A third of the way to the other end. */
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

/* Whether control points are where a curve along the points can have them: before their ends, and not
 * beyond reason. */
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
  double m[4][5];
  int count = list_unknowns(ends, list);
  for (int i = 0; i < count; i++) {
    for (int j = 0; j < count; j++)
      m[i][j] = s->b[list[i].end][list[j].end] *
                (list[i].along.x * list[j].along.x + list[i].along.y * list[j].along.y);
    m[i][count] = list[i].along.x * s->r[list[i].end].x + list[i].along.y * s->r[list[i].end].y;
  }
  bool is_solved = solve(m, count);
  control[0] = ends[0].point;
  control[1] = ends[1].point;
  for (int i = 0; i < count && is_solved; i++) {
    control[list[i].end].x += m[i][count] * list[i].along.x;
    control[list[i].end].y += m[i][count] * list[i].along.y;
  }
  if (!is_solved || !is_sound(ends, control))
    place_plainly(ends, control);
}

/* ---------------------------------------------------------------- fitting */

static double far_from(const cubic *c, celspan_point point, double t) {
  celspan_point at = point_at(c, t);
  return cs_number_length(at.x - point.x, at.y - point.y);
}

/* How far points are off: the farthest, and root mean square. */
typedef struct distances {
  double most, mean;
} distances;

/* After parameters have come nearer. step: of points. */
static distances bring_nearer(const cubic *c, const celspan_point *points, size_t count,
                              size_t step, double *parameters) {
  double most = 0, squares = 0, asked = 0;
  for (size_t i = 0; i < count; i += step) {
    parameters[i] = nearer(c, points[i], parameters[i]);
    double far = far_from(c, points[i], parameters[i]);
    most = far > most ? far : most;
    squares += far * far;
    asked++;
  }
  return (distances){most, sqrt(squares / asked)};
}

bool cs_cubic_fit(const celspan_point *points, size_t count, const cs_cubic_end ends[2],
                  double tolerance, double mean, double *parameters, celspan_point control[2]) {
  size_t step = count / ASKED + 1;
  begin_parameters(points, count, ends, parameters);
  place_plainly(ends, control);
  if (count == 0)
    return true;
  for (int round = 0; round < ROUNDS; round++) {
    sums s = {.b = {{0}}};
    for (size_t i = 0; i < count; i += step)
      add_point(&s, ends, points[i], parameters[i]);
    place_controls(&s, ends, control);
    const cubic c = {{ends[0].point, control[0], control[1], ends[1].point}};
    distances off = bring_nearer(&c, points, count, step, parameters);
    if (off.most <= tolerance && off.mean <= mean) {
      if (step == 1)
        return true;
      off = bring_nearer(&c, points, count, 1, parameters);
      return off.most <= tolerance && off.mean <= mean;
    }
    if (off.most > HOPELESS * tolerance)
      return false;
  }
  return false;
}
