/* NURBS to rational Bezier pieces by blossoms.
 * Source: Ramshaw, Blossoms are polar forms, 1989; Piegl and Tiller, The NURBS book, 1997.
 *
 *      o           o           o  control points of the curve
 *          .--*--.
 *        .'       '.              every knot span that is not empty becomes one Bezier piece;
 *       *           *--.          the pieces join (*) at the knots
 *                       '*
 *   ---+------+-----+----+---     knots;  [a, c] is one span
 *      a      c
 *
 * Bezier point j of the knot span [a, c] is the blossom at (degree - j) times a and j times c: de
 * Boor's recursion with another argument at every level. Its denominators cover [a, c], so they are
 * never 0 in a span that is not empty. Knots enter only as sums of differences from a. So adding a
 * number to all knots changes no bit, and a periodic curve has no seam.
 */
#include <math.h>

#include "base/number.h"
#include "model/geometry/bezier.h"
#include "model/geometry/outline.h"

#define COUNT_LIMIT 100000
#define WEIGHT_RATIO 1e6

/* A checked description, with its defaults filled in. */
typedef struct curve {
  const celspan_nurbs_desc *desc;
  size_t count; /* points */
  size_t degree;
  size_t knot_count; /* 0: uniform */
  bool is_periodic;
  double largest_weight;
} curve;

/* ---------------------------------------------------------------- checks */

static celspan_status check_counts(celspan_context *context, const celspan_nurbs_desc *desc) {
  int degree = desc->degree;
  if (degree < 1 || degree > CS_BEZIER_DEGREE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "the degree is %d; it must be from 1 to %d",
                   degree, CS_BEZIER_DEGREE);
  if (desc->point_count < (size_t)degree + 1 || desc->point_count > COUNT_LIMIT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "there are %zu points; degree %d needs from %d to %d", desc->point_count, degree,
                   degree + 1, COUNT_LIMIT);
  bool is_periodic = desc->closure == CELSPAN_NURBS_PERIODIC;
  size_t wanted = desc->point_count + (is_periodic ? 1 : (size_t)degree + 1);
  if (desc->knots && desc->knot_count != wanted)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "there are %zu knots; a %s curve of degree %d with %zu points needs %zu",
                   desc->knot_count, is_periodic ? "periodic" : "clamped", degree,
                   desc->point_count, wanted);
  return CELSPAN_OK;
}

static celspan_status refuse_infinite(celspan_context *context, const char *list, size_t i,
                                      double number) {
  return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s[%zu] must be a finite number, got %s", list,
                 i + 1,
                 isnan(number) ? "nan"
                 : number > 0  ? "inf"
                               : "-inf");
}

static celspan_status check_weights(celspan_context *context, const celspan_nurbs_desc *desc,
                                    double *largest) {
  double least = HUGE_VAL;
  *largest = 0;
  for (size_t i = 0; i < desc->point_count; i++) {
    double weight = desc->weights ? desc->weights[i] : 1;
    if (!isfinite(weight))
      return refuse_infinite(context, "weights", i, weight);
    if (!(weight > 0) || !cs_number_is_sane(weight))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "weight %zu is %g; weights must be above 0 and at most 1e12", i + 1, weight);
    least = fmin(least, weight);
    *largest = fmax(*largest, weight);
  }
  if (!(*largest <= WEIGHT_RATIO * least))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "the weights go from %g to %g; the largest may be 1e6 times the smallest", least,
                   *largest);
  return CELSPAN_OK;
}

static celspan_status check_order(celspan_context *context, const curve *c) {
  const double *knots = c->desc->knots;
  for (size_t i = 0; i < c->knot_count; i++) {
    if (!isfinite(knots[i]))
      return refuse_infinite(context, "knots", i, knots[i]);
    if (!cs_number_is_sane(knots[i]))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "knot %zu is %g; it must be between -1e12 and 1e12", i + 1, knots[i]);
    if (i > 0 && knots[i] < knots[i - 1])
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "knot %zu is %g, less than knot %zu, which is %g; knots must not decrease",
                     i + 1, knots[i], i, knots[i - 1]);
  }
  size_t first = c->is_periodic ? 0 : c->degree, last = c->count;
  if (!(knots[first] < knots[last]))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "knots %zu to %zu are all %g; the curve has no length between them", first + 1,
                   last + 1, knots[first]);
  return CELSPAN_OK;
}

/* The number of equal knots from `from` on, and where they end. The last knot of a period is the
 * same as its first one, so the count continues at the other end. */
static size_t knot_row(const curve *c, size_t from, size_t *end) {
  const double *knots = c->desc->knots;
  size_t next = from + 1, count;
  while (next < c->knot_count && knots[next] == knots[from])
    next++;
  *end = next;
  count = next - from;
  for (size_t i = 1; c->is_periodic && next == c->knot_count && knots[i] == knots[0]; i++)
    count++;
  return count;
}

static celspan_status check_rows(celspan_context *context, const curve *c) {
  for (size_t i = 0, end; i < c->knot_count; i = end) {
    size_t row = knot_row(c, i, &end);
    bool is_end = !c->is_periodic && (i == 0 || end == c->knot_count);
    size_t allowed = c->degree + (is_end ? 1 : 0);
    if (row > allowed)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "knot %zu, %g, appears %zu times; degree %zu allows %zu there", i + 1,
                     c->desc->knots[i], row, c->degree, allowed);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- knot spans */

/* The distance from knot i to the next one. Uniform knots are equal at both ends of a clamped
 * curve. */
static double knot_step(const curve *c, size_t i) {
  if (c->knot_count > 0)
    return c->desc->knots[i + 1] - c->desc->knots[i];
  bool is_end = !c->is_periodic && (i < c->degree || i >= c->count);
  return is_end ? 0 : 1;
}

/* The knots around the span that begins at knot `span`, as distances from the beginning of the
 * span: knots[degree - 1] is 0, and knots[degree] is the end of the span. A period has as many
 * distances as points; after the last one they repeat. */
static void knots_around(const curve *c, size_t span, double *knots) {
  size_t zero = c->degree - 1, period = c->is_periodic ? c->count : SIZE_MAX;
  size_t after = span, before = span;
  knots[zero] = 0;
  for (size_t i = zero; i < zero + c->degree; i++) {
    knots[i + 1] = knots[i] + knot_step(c, after);
    after = after + 1 == period ? 0 : after + 1;
  }
  for (size_t i = zero; i > 0; i--) {
    before = before == 0 ? period - 1 : before - 1;
    knots[i - 1] = knots[i] - knot_step(c, before);
  }
}

static cs_hpoint weighted_point(const curve *c, size_t i) {
  celspan_point p = c->desc->points[i];
  double w = c->desc->weights ? c->desc->weights[i] / c->largest_weight : 1;
  return (cs_hpoint){p.x * w, p.y * w, w};
}

/* The blossom of the span's points at (degree - ends) times 0 and `ends` times the span's end. */
static cs_hpoint blossom(const cs_hpoint *points, const double *knots, size_t degree, size_t ends) {
  cs_hpoint work[CS_BEZIER_DEGREE + 1];
  for (size_t i = 0; i <= degree; i++)
    work[i] = points[i];
  for (size_t level = 1; level <= degree; level++) {
    double argument = level <= ends ? knots[degree] : 0;
    for (size_t i = degree; i >= level; i--) {
      double low = knots[i - 1], high = knots[i - level + degree];
      double share = (argument - low) / (high - low);
      cs_hpoint a = work[i - 1], b = work[i];
      work[i] = (cs_hpoint){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                            a.w + share * (b.w - a.w)};
    }
  }
  return work[degree];
}

/* points[0..degree] are the points of the span; a contour begins before the first piece. */
static celspan_status add_span(celspan_context *context, cs_outline *outline, const curve *c,
                               size_t span, bool is_first) {
  cs_hpoint points[CS_BEZIER_DEGREE + 1], bezier[CS_BEZIER_DEGREE + 1];
  double knots[2 * CS_BEZIER_DEGREE];
  size_t first_point = c->is_periodic ? span : span - c->degree;
  for (size_t i = 0; i <= c->degree; i++)
    points[i] = weighted_point(c, (first_point + i) % c->count);
  knots_around(c, span, knots);
  for (size_t i = 0; i <= c->degree; i++)
    bezier[i] = blossom(points, knots, c->degree, i);
  if (is_first)
    CS_TRY(cs_outline_move(context, outline, bezier[0]));
  return cs_outline_piece(context, outline, (int)c->degree, bezier + 1);
}

/* Makes a periodic curve end exactly where it began: they may differ by rounding. */
static void snap_seam(cs_outline *outline) {
  size_t first = outline->contours[outline->contour_count - 1];
  outline->points[outline->point_count - 1] = outline->points[outline->starts[first]];
}

static celspan_status add_spans(celspan_context *context, cs_outline *outline, const curve *c) {
  bool is_first = true;
  size_t end = c->count;
  for (size_t span = c->is_periodic ? 0 : c->degree; span < end; span++) {
    if (!(knot_step(c, span) > 0))
      continue;
    CS_TRY(add_span(context, outline, c, span, is_first));
    is_first = false;
  }
  if (c->is_periodic)
    snap_seam(outline);
  return cs_outline_close(context, outline);
}

celspan_status cs_outline_nurbs(celspan_context *context, cs_outline *outline,
                                const celspan_nurbs_desc *desc) {
  CS_TRY(check_counts(context, desc));
  curve c = {.desc = desc,
             .count = desc->point_count,
             .degree = (size_t)desc->degree,
             .knot_count = desc->knots ? desc->knot_count : 0,
             .is_periodic = desc->closure == CELSPAN_NURBS_PERIODIC};
  CS_TRY(check_weights(context, desc, &c.largest_weight));
  if (desc->knots) {
    CS_TRY(check_order(context, &c));
    CS_TRY(check_rows(context, &c));
  }
  return add_spans(context, outline, &c);
}
