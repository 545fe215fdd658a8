/* Round corners: where two straight sides meet, each ends early, and a curve leads from one to the
 * other. It is the arc of a circle if both end equally early.
 *
 *      side in        c, the corner
 *    ----------*. . .         the curve is rational, of degree 2; its middle weight is the sine of
 *          cut   `. .         half the angle between the sides
 *                  `*
 *                   | side out
 */
#include <math.h>

#include "base/number.h"
#include "celspan/operators.h"
#include "model/operators/operate.h"
#include "model/scene/check.h"

#define STRAIGHT 1e-12 /* sine: sides that meet at a smaller angle have no corner */

typedef struct rounding {
  cs_operation operation;
  double radius;
} rounding;

typedef struct piece {
  cs_bezier curve;
  celspan_point a, b; /* the ends of the curve */
  double length;      /* the length of a straight side, else 0 */
} piece;

static void load(const cs_lines *lines, size_t i, piece *out) {
  cs_lines_load(lines, i, &out->curve);
  out->a = cs_hpoint_place(out->curve.points[0]);
  out->b = cs_hpoint_place(out->curve.points[out->curve.degree]);
  out->length =
      out->curve.degree == 1 ? cs_number_length(out->b.x - out->a.x, out->b.y - out->a.y) : 0;
}

/* A corner between two sides: where the sides end, and the weight of the curve between. */
typedef struct corner {
  bool is_round;
  celspan_point from, to;
  double weight;
} corner;

static corner corner_of(const piece *in, const piece *out, double radius) {
  corner c = {.is_round = false};
  if (!(in->length > 0) || !(out->length > 0))
    return c;
  double ix = (in->b.x - in->a.x) / in->length, iy = (in->b.y - in->a.y) / in->length;
  double ox = (out->b.x - out->a.x) / out->length, oy = (out->b.y - out->a.y) / out->length;
  if (fabs(ix * oy - iy * ox) <= STRAIGHT)
    return c;
  double before = fmin(radius, in->length / 2), after = fmin(radius, out->length / 2);
  c.is_round = true;
  c.from = (celspan_point){in->b.x - before * ix, in->b.y - before * iy};
  c.to = (celspan_point){out->a.x + after * ox, out->a.y + after * oy};
  /* by the length of the sum, which is exact where the sides nearly turn back, in a needle */
  c.weight = 0.5 * cs_number_length(ix + ox, iy + oy);
  return c;
}

static celspan_status add_corner(celspan_context *context, const corner *c, celspan_point at,
                                 cs_lines *to) {
  double w = c->weight;
  const cs_bezier arc = {
      2, {{c->from.x, c->from.y, 1}, {w * at.x, w * at.y, w}, {c->to.x, c->to.y, 1}}};
  return cs_lines_add(context, to, &arc);
}

/* A piece between two corners. */
static celspan_status add_side(celspan_context *context, const piece *p, const corner *before,
                               const corner *after, cs_lines *to) {
  celspan_point from = before->is_round ? before->to : p->a;
  celspan_point end = after->is_round ? after->from : p->b;
  cs_bezier side = p->curve;
  if (after->is_round)
    side = cs_bezier_line((cs_hpoint){from.x, from.y, 1}, (cs_hpoint){end.x, end.y, 1});
  if (after->is_round && from.x == end.x && from.y == end.y)
    return CELSPAN_OK;
  return cs_lines_add(context, to, &side);
}

/* The next piece that has a length, going round where the contour is closed; false: none. */
static bool next_of(const cs_lines *lines, const cs_lines_contour *contour, size_t i, piece *out) {
  size_t count = contour->end - contour->begin;
  for (size_t step = 1; step <= count; step++) {
    size_t next = i + step;
    if (next >= contour->end) {
      if (!contour->is_closed)
        return false;
      next -= count;
    }
    load(lines, next, out);
    if (out->curve.degree > 1 || out->length > 0)
      return true;
  }
  return false;
}

static celspan_status round_contour(const rounding *r, const cs_lines *lines,
                                    const cs_lines_contour *contour, double radius, cs_lines *to) {
  celspan_context *context = r->operation.context;
  const corner none = {.is_round = false};
  corner before = none, after;
  piece now, next;
  bool is_begun = false;
  for (size_t i = contour->end; contour->is_closed && i-- > contour->begin;) {
    load(lines, i, &now); /* the last piece with a length leads to the first */
    if (now.curve.degree > 1 || now.length > 0) {
      before = next_of(lines, contour, i, &next) ? corner_of(&now, &next, radius) : none;
      break;
    }
  }
  for (size_t i = contour->begin; i < contour->end; i++) {
    load(lines, i, &now);
    if (now.curve.degree == 1 && !(now.length > 0))
      continue;
    if (!is_begun)
      CS_TRY(cs_lines_begin(context, to,
                            before.is_round ? (cs_hpoint){before.to.x, before.to.y, 1}
                                            : now.curve.points[0]));
    is_begun = true;
    after = next_of(lines, contour, i, &next) ? corner_of(&now, &next, radius) : none;
    CS_TRY(add_side(context, &now, &before, &after, to));
    if (after.is_round)
      CS_TRY(add_corner(context, &after, now.b, to));
    before = after;
  }
  if (!is_begun) { /* a dot */
    load(lines, contour->begin, &now);
    CS_TRY(cs_lines_begin(context, to, now.curve.points[0]));
    CS_TRY(cs_lines_add(context, to, &now.curve));
  }
  return cs_lines_end(context, to, contour->is_closed);
}

static celspan_status change(cs_operation *operation, const cs_lines *from,
                             const celspan_matrix *place, double scale, cs_lines *to) {
  (void)place;
  const rounding *r = (const rounding *)operation;
  size_t closed_at = 0;
  for (size_t i = 0; i < from->outline.contour_count; i++) {
    const cs_lines_contour contour = cs_lines_contour_at(from, i, &closed_at);
    CS_TRY(round_contour(r, from, &contour, r->radius / scale, to));
  }
  return CELSPAN_OK;
}

celspan_status celspan_object_round_corners(celspan_context *context, celspan_object *object,
                                            double radius, celspan_object **out) {
  CS_TRY(cs_check_given(context, "round_corners", "the object", object));
  CS_TRY(cs_check_size(context, "round_corners", "radius", radius));
  rounding r = {.operation = {context, "round_corners", change}, .radius = radius};
  if (radius > 0)
    return cs_operate(&r.operation, object, out);
  *out = celspan_object_ref(object);
  return CELSPAN_OK;
}
