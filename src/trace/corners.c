#include "trace/corners.h"

#include <math.h>

/* The points about a corner that are not asked, on either side; the fewest that are; how many points
 * lie at least between two corners; and the most that a corner may be away from its point. */
enum { SKIPPED = 1, FEWEST = 3, APART = 3 };
#define FAR 1.15

/* ---------------------------------------------------------------- parabolas */

static celspan_point at(const cs_points *points, ptrdiff_t i) {
  ptrdiff_t count = (ptrdiff_t)points->count;
  return points->items[((i % count) + count) % count];
}

/* The length from the origin to a point, along the points between; below 0 against the steps. */
static double length_to(const cs_stretch_of_points *s, int offset) {
  double length = 0;
  int sign = offset < 0 ? -1 : 1;
  for (int i = 0; i != offset; i += sign) {
    celspan_point a = at(s->points, s->origin + s->step * i);
    celspan_point b = at(s->points, s->origin + s->step * (i + sign));
    length += sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  }
  return sign * length;
}

/* Sums of the powers of the lengths, and of points times them. */
typedef struct sums {
  double power[5];
  celspan_point moment[3];
  double squares;
} sums;

static sums sum_up(const cs_stretch_of_points *s) {
  sums sum = {.power = {0}};
  double u = length_to(s, s->skipped);
  for (int i = s->skipped; i < s->skipped + s->count; i++) {
    celspan_point p = at(s->points, s->origin + s->step * i), middle = at(s->points, s->origin);
    p.x -= middle.x, p.y -= middle.y;
    double powers[5] = {1, u, u * u, u * u * u, u * u * u * u};
    for (int k = 0; k < 5; k++)
      sum.power[k] += powers[k];
    sum.squares += p.x * p.x + p.y * p.y;
    for (int k = 0; k < 3; k++) {
      sum.moment[k].x += powers[k] * p.x;
      sum.moment[k].y += powers[k] * p.y;
    }
    celspan_point next = at(s->points, s->origin + s->step * (i + 1));
    next.x -= middle.x, next.y -= middle.y;
    u += sqrt((next.x - p.x) * (next.x - p.x) + (next.y - p.y) * (next.y - p.y));
  }
  return sum;
}

/* The coefficients of the parabola, by Cramer's rule; of the line where there are but two points, or
 * all are in one place. */
static void coefficients(const double p[5], const double m[3], double out[3]) {
  double a = p[2] * p[4] - p[3] * p[3], b = p[1] * p[4] - p[2] * p[3];
  double c = p[1] * p[3] - p[2] * p[2], all = p[0] * a - p[1] * b + p[2] * c;
  if (all > 1e-6 && p[0] > 2.5) {
    double d = p[0] * p[4] - p[2] * p[2], e = p[0] * p[3] - p[1] * p[2];
    double f = p[0] * p[2] - p[1] * p[1];
    out[0] = (a * m[0] - b * m[1] + c * m[2]) / all;
    out[1] = (-b * m[0] + d * m[1] - e * m[2]) / all;
    out[2] = (c * m[0] - e * m[1] + f * m[2]) / all;
    return;
  }
  double line = p[0] * p[2] - p[1] * p[1];
  out[0] = line > 1e-9 ? (p[2] * m[0] - p[1] * m[1]) / line : m[0] / p[0];
  out[1] = line > 1e-9 ? (p[0] * m[1] - p[1] * m[0]) / line : 0;
  out[2] = 0;
}

cs_parabola cs_parabola_at(const cs_stretch_of_points *stretch) {
  sums s = sum_up(stretch);
  celspan_point middle = at(stretch->points, stretch->origin);
  double x[3], y[3], explained = 0;
  coefficients(s.power, (double[]){s.moment[0].x, s.moment[1].x, s.moment[2].x}, x);
  coefficients(s.power, (double[]){s.moment[0].y, s.moment[1].y, s.moment[2].y}, y);
  for (int k = 0; k < 3; k++)
    explained += x[k] * s.moment[k].x + y[k] * s.moment[k].y;
  cs_parabola out = {.point = {middle.x + x[0], middle.y + y[0]},
                     .error = (s.squares - explained) / stretch->count};
  double length = sqrt(x[1] * x[1] + y[1] * y[1]);
  if (length > 1e-9)
    out.tangent = (celspan_point){x[1] / length, y[1] / length};
  return out;
}

/* ---------------------------------------------------------------- angles */

typedef struct finder {
  const cs_points *points;
  bool is_closed;
  const cs_fit_rules *rules;
  double *turns, *errors; /* by point */
} finder;

/* The border before (step -1) or after (1) a point, prolonged to it. false: there are too few points.
 */
static bool come_in(const finder *f, size_t i, int step, cs_parabola *out) {
  ptrdiff_t count = (ptrdiff_t)f->points->count;
  ptrdiff_t room = f->is_closed ? count / 2 : step > 0 ? count - 1 - (ptrdiff_t)i : (ptrdiff_t)i;
  int most = f->rules->about < room - SKIPPED ? f->rules->about : (int)(room - SKIPPED);
  if (most < FEWEST)
    return false;
  for (int asked = most; asked >= FEWEST; asked--) {
    const cs_stretch_of_points side = {f->points, (ptrdiff_t)i, step, SKIPPED + 1, asked};
    *out = cs_parabola_at(&side);
    if (out->error <= f->rules->noise * f->rules->noise)
      break;
  }
  return true;
}

/* Whether one parabola goes through the points about one. */
static bool is_smooth(const finder *f, size_t i) {
  ptrdiff_t count = (ptrdiff_t)f->points->count, near = f->rules->near;
  bool has_room =
      f->is_closed ? 2 * near + 1 <= count : (ptrdiff_t)i >= near && (ptrdiff_t)i + near < count;
  const cs_stretch_of_points both = {f->points, (ptrdiff_t)i, 1, -(int)near, 2 * (int)near + 1};
  return has_room && cs_parabola_at(&both).error <= f->rules->smooth * f->rules->smooth;
}

/* The cosine of the turn at a point, 1 straight on, -1 back, and how far points are off its sides. */
static void measure(const finder *f, size_t i) {
  cs_parabola before, after;
  f->turns[i] = 1;
  if (is_smooth(f, i) || !come_in(f, i, -1, &before) || !come_in(f, i, 1, &after))
    return;
  f->turns[i] = -(before.tangent.x * after.tangent.x + before.tangent.y * after.tangent.y);
  double dx = before.point.x - after.point.x, dy = before.point.y - after.point.y;
  f->errors[i] = before.error + after.error + 0.1 * (dx * dx + dy * dy);
}

/* Where the lines of both sides intersect, or on the way there, where that is too far away: of a sharp
 * corner antialiasing takes more. */
static celspan_point corner_at(const finder *f, size_t i) {
  cs_parabola before, after;
  celspan_point point = f->points->items[i];
  if (!come_in(f, i, -1, &before) || !come_in(f, i, 1, &after))
    return point;
  celspan_point in = before.tangent, out = after.tangent;
  double area = in.x * out.y - in.y * out.x;
  if (fabs(area) < 0.05)
    return point;
  double dx = after.point.x - before.point.x, dy = after.point.y - before.point.y;
  double way = (dx * out.y - dy * out.x) / area;
  dx = before.point.x + way * in.x - point.x;
  dy = before.point.y + way * in.y - point.y;
  double far = sqrt(dx * dx + dy * dy);
  double most = f->turns[i] < 0 ? FAR * (1 - 0.4 * f->turns[i]) : FAR;
  double held = far > most ? most / far : 1;
  return (celspan_point){point.x + held * dx, point.y + held * dy};
}

/* Whether of all points that turn enough, within `about` of it, none is nearer to its sides; of equals
 * the first. */
static bool is_best(const finder *f, size_t i) {
  ptrdiff_t count = (ptrdiff_t)f->points->count;
  for (ptrdiff_t k = -APART; k <= APART; k++) {
    ptrdiff_t other = (ptrdiff_t)i + k;
    if (k == 0 || (!f->is_closed && (other < 0 || other >= count)))
      continue;
    size_t at = (size_t)(((other % count) + count) % count);
    bool is_corner = at != i && f->turns[at] <= f->rules->turn;
    if (is_corner && (f->errors[at] < f->errors[i] || (f->errors[at] == f->errors[i] && k < 0)))
      return false;
  }
  return true;
}

static celspan_status find(celspan_context *context, const finder *f, cs_corner_list *out) {
  for (size_t i = 0; i < f->points->count; i++)
    measure(f, i);
  for (size_t i = 0; i < f->points->count; i++) {
    if (f->turns[i] > f->rules->turn || !is_best(f, i))
      continue;
    CS_TRY(cs_mem_reserve(context, (void **)&out->items, &out->capacity, out->count + 1,
                          sizeof *out->items));
    out->items[out->count++] = (cs_corner){i, corner_at(f, i)};
  }
  return CELSPAN_OK;
}

celspan_status cs_corners_find(celspan_context *context, const cs_points *points, bool is_closed,
                               const cs_fit_rules *rules, cs_corner_list *out) {
  size_t count = points->count;
  finder f = {points, is_closed, rules, NULL, NULL};
  if (count == 0)
    return CELSPAN_OK;
  f.turns = cs_mem_array(context->memory, count, sizeof *f.turns);
  f.errors = cs_mem_array(context->memory, count, sizeof *f.errors);
  celspan_status status = f.turns && f.errors ? find(context, &f, out) : cs_fail_memory(context);
  cs_mem_free(context->memory, f.turns, count * sizeof *f.turns);
  cs_mem_free(context->memory, f.errors, count * sizeof *f.errors);
  return status;
}
