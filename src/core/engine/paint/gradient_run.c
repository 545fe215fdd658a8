/* Runs of one gradient without perspective: cut at its stops, and halved between them as far as its
 * geometry asks for, without comparing colours.
 *
 *     RADIAL, a row through the circles of its stops:
 *
 *              . - ~ ~ ~ - .
 *            '   . - ~ - .   '
 *     ------+---+----+----+---+------ row       cut where it meets a circle, and at the foot of
 *           '   '    |    '   '                 the centre, where the distance turns round
 *            ' .  '- o -'  . '
 *                 centre
 *
 *     LINEAR: where the row meets the lines of its stops
 */
#include "engine/paint/run.h"

#include "engine/paint/halving.h"

#include <math.h>

/* A gradient along a row. `at` of a point is its place along the stops. */
typedef struct arc {
  cs_halving_curve curve;
  cs_painter *painter;
  const cs_gradient_table *table;
  double u, v;       /* the values of the shade's planes at x = 0 */
  double bend;       /* RADIAL: second derivative of the distance r along the row, times r cubed,
                        where r is `at` plus, with a focus, the part subtracted */
  int32_t from, end; /* the columns of the run that are not yet written */
  const cs_gradient_table_section *section; /* between the current two cuts */
  /* in this section: the greatest change of a channel from 0 to 1 along the gradient */
  double steepness;
} arc;

static const celspan_texture *texture_of(const arc *a) { return a->table->shade->texture; }

/* As cs_shade_at. */
static double at_column(const arc *a, int32_t column) {
  const cs_shade *shade = a->table->shade;
  double x = column + 0.5, u = shade->plane[0][0] * x + a->u;
  if (shade->texture->kind == CS_TEXTURE_LINEAR)
    return u;
  double v = shade->plane[1][0] * x + a->v;
  return sqrt(u * u + v * v) - shade->eccentricity * u;
}

/* What a focus subtracts from the distance at a column. */
static double taken_off(const arc *a, int32_t column) {
  const cs_shade *shade = a->table->shade;
  return shade->eccentricity * (shade->plane[0][0] * (column + 0.5) + a->u);
}

/* The colour of a column, by the current section even where rounding puts the column beyond its
 * end. */
static cs_halving_point curve_point(arc *a, int32_t column) {
  double at = at_column(a, column);
  a->painter->evaluations++;
  return (cs_halving_point){column, at, cs_gradient_table_mix(a->section, at)};
}

/* ---------------------------------------------------------------- between two cuts */

static double steepness_of(const cs_gradient_table_section *section) {
  double most = 0;
  for (int c = 0; c < 4; c++)
    most = cs_number_most(fabs((double)section->step[c]), most);
  return most * section->scale;
}

/* The second derivative of the distance is greatest at the end that is nearer the centre. Usually
 * the derivative at that end is small enough to decide; otherwise the distances at the quarters are
 * compared with the line, and no colours are needed. */
static celspan_status test(cs_halving_curve *curve, const cs_halving_point *first,
                           const cs_halving_point *last, bool *is_straight) {
  const arc *a = (const arc *)curve;
  double columns = last->column - first->column;
  double near = cs_number_least(first->at + taken_off(a, first->column),
                                last->at + taken_off(a, last->column));
  double limit = (double)curve->tolerance;
  *is_straight = true;
  if (columns < 2 || columns * columns * a->bend * a->steepness <= 8 * limit * near * near * near)
    return CELSPAN_OK;
  /* The middle comes first, because the curve is mostly farthest from the line there. */
  static const int quarters[] = {2, 1, 3};
  for (int k = 0; k < 3 && *is_straight; k++) {
    int32_t column = cs_halving_quarter(cs_halving_run(first, last), quarters[k]);
    double u = (column - first->column) / columns;
    double off = at_column(a, column) - (first->at + u * (last->at - first->at));
    *is_straight = !(fabs(off) * a->steepness > limit);
  }
  return CELSPAN_OK;
}

static celspan_status split(cs_halving_curve *curve, int32_t column, cs_halving_point points[2]) {
  arc *a = (arc *)curve;
  points[0] = curve_point(a, column);
  points[1] = curve_point(a, column + 1);
  return CELSPAN_OK;
}

/* Writes the columns up to x, the next place at which the gradient bends. */
static celspan_status put_until(arc *a, double x) {
  int32_t from = a->from, end = cs_number_first_centre(x);
  end = end < a->end ? end : a->end;
  if (end <= from)
    return CELSPAN_OK;
  a->from = end;
  double at = at_column(a, from + (end - from) / 2);
  a->section = &a->table->sections[cs_gradient_table_section_at(a->table->shade, at)];
  a->steepness = steepness_of(a->section);
  cs_halving_point first = curve_point(a, from), last = curve_point(a, end - 1);
  return cs_halving_fit(&a->curve, &first, &last);
}

/* ---------------------------------------------------------------- rows */

static celspan_status run_linear(arc *a) {
  const celspan_texture *texture = texture_of(a);
  double step = a->table->shade->plane[0][0];
  size_t count = step != 0 ? texture->variation->stop_count : 0;
  for (size_t i = 0; i < count; i++) {
    const cs_stop *stop = &texture->variation->stops[step > 0 ? i : count - 1 - i];
    CS_TRY(put_until(a, (stop->at - a->u) / step));
  }
  return put_until(a, a->end);
}

/* Where a row enters and leaves the circle of a place along the stops: the ends of the interval
 * where `at` is at most the place. False when row and circle do not meet. */
static bool find_chord(const arc *a, double at, double *low, double *high) {
  const cs_shade *shade = a->table->shade;
  double su = shade->plane[0][0], sv = shade->plane[1][0], e = shade->eccentricity;
  double speed = su * su * (1 - e * e) + sv * sv;
  double b = a->u * su * (1 - e * e) + a->v * sv - at * e * su;
  double c = a->u * a->u * (1 - e * e) + a->v * a->v - 2 * at * e * a->u - at * at;
  double root = b * b - speed * c, square = at * at - a->bend / speed;
  if (e > 0) {
    *low = (-b - sqrt(root)) / speed;
    *high = (-b + sqrt(root)) / speed;
    return root > 0;
  }
  *low = -(a->u * su + a->v * sv) / speed - sqrt(square / speed);
  *high = -(a->u * su + a->v * sv) / speed + sqrt(square / speed);
  return square > 0;
}

static celspan_status run_radial(arc *a) {
  const celspan_texture *texture = texture_of(a);
  const cs_shade *shade = a->table->shade;
  double su = shade->plane[0][0], sv = shade->plane[1][0], e = shade->eccentricity;
  double speed = su * su + sv * sv, cross = a->u * sv - a->v * su, low, high;
  if (!(speed > 0))
    return put_until(a, a->end);
  a->bend = cross * cross;
  for (size_t i = texture->variation->stop_count; i-- > 0;)
    if (find_chord(a, texture->variation->stops[i].at, &low, &high))
      CS_TRY(put_until(a, low));
  /* Where `at` is least: with a focus, beside the place that is nearest to it. */
  double beside = e * su * fabs(cross) / (speed * sqrt(speed - e * e * su * su));
  CS_TRY(put_until(a, beside - (a->u * su + a->v * sv) / speed));
  for (size_t i = 0; i < texture->variation->stop_count; i++)
    if (find_chord(a, texture->variation->stops[i].at, &low, &high))
      CS_TRY(put_until(a, high));
  return put_until(a, a->end);
}

bool cs_gradient_run_fits(const cs_gradient_table *table) {
  return table && table->shade->is_affine &&
         (table->shade->texture->kind == CS_TEXTURE_LINEAR ||
          table->shade->texture->kind == CS_TEXTURE_RADIAL);
}

celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table, cs_run run,
                               cs_row *row) {
  const double *p = table->shade->plane[0], *q = table->shade->plane[1];
  arc a = {.curve = {painter->context, cs_halving_tolerance(painter->stack->span_error), row, test,
                     split},
           .painter = painter,
           .table = table,
           .u = p[1] * run.y + p[2],
           .v = q[1] * run.y + q[2],
           .from = run.x0,
           .end = run.x1};
  return table->shade->texture->kind == CS_TEXTURE_LINEAR ? run_linear(&a) : run_radial(&a);
}
