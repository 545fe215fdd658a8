/* Borders become arcs: the pieces of a chain between two heights, as lines and cubic curves within
 * the frame.
 *
 *     chain  |  |      frame         rational pieces are halved until cubic curves with the same
 *          --+--| top  0|  /         ends, tangents and middles are as good; what is left of the
 *            |  |       | /          frame or right of it becomes a part of its side
 *          --+--| foot  |/
 */
#include <math.h>

#include "inside/geometry.h"
#include "writers/parcels/making.h"

enum { HALVINGS = 6, SIDE_HALVINGS = 8, ROOT_STEPS = 60 };
#define SIDE ((double)PLANEFILE_SIDE)
#define GOOD 0.5 /* units: how far a cubic curve may be from a rational one */

/* A Bezier curve of a degree in units; x and y are multiplied by w. */
typedef struct bend {
  int degree;
  bool is_rational;
  cs_hpoint points[4];
} bend;

static bend bend_of(const planefile_band *band, const planefile_piece *piece) {
  bend out = {.degree = piece->degree, .is_rational = piece->is_rational};
  for (int i = 0; i <= piece->degree; i++) {
    const planefile_point *p = &band->points[piece->point + (uint32_t)i];
    double w = piece->is_rational ? (double)p->w / PLANEFILE_WEIGHT : 1;
    out.points[i] = (cs_hpoint){p->x * w, p->y * w, w};
  }
  return out;
}

static cs_hpoint mix(cs_hpoint a, cs_hpoint b, double t) {
  return (cs_hpoint){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.w + t * (b.w - a.w)};
}

/* Cuts a curve in two; either may be NULL. */
static void cut(const bend *curve, double t, bend *first, bend *second) {
  bend now = *curve;
  if (first)
    *first = *curve;
  for (int level = 1; level <= curve->degree; level++) {
    for (int i = 0; i + level <= curve->degree; i++)
      now.points[i] = mix(now.points[i], now.points[i + 1], t);
    if (first)
      first->points[level] = now.points[0];
  }
  if (second)
    *second = now;
}

static celspan_point end_of(const bend *curve) {
  return cs_hpoint_place(curve->points[curve->degree]);
}

/* Where a curve comes to a number on an axis, between its ends. */
static double find_root(const bend *curve, bool is_y, double number) {
  double low = 0, high = 1;
  celspan_point begin = cs_hpoint_place(curve->points[0]), end = end_of(curve);
  bool grows = is_y ? begin.y < end.y : begin.x < end.x;
  for (int i = 0; i < ROOT_STEPS; i++) {
    bend first;
    double middle = (low + high) / 2;
    cut(curve, middle, &first, NULL);
    celspan_point there = end_of(&first);
    if (((is_y ? there.y : there.x) < number) == grows)
      low = middle;
    else
      high = middle;
  }
  return (low + high) / 2;
}

static void set_end(bend *curve, int i, celspan_point at) {
  double w = curve->points[i].w;
  curve->points[i] = (cs_hpoint){at.x * w, at.y * w, w};
}

/* Leaves the part of a curve between two heights, of which one at least is within it. */
static void cut_heights(bend *curve, double top, double foot) {
  if (cs_hpoint_place(curve->points[0]).y < top) {
    bend whole = *curve;
    cut(&whole, find_root(&whole, true, top), NULL, curve);
    set_end(curve, 0, (celspan_point){cs_hpoint_place(curve->points[0]).x, top});
  }
  if (end_of(curve).y > foot) {
    bend whole = *curve;
    cut(&whole, find_root(&whole, true, foot), curve, NULL);
    set_end(curve, curve->degree, (celspan_point){end_of(curve).x, foot});
  }
}

/* ---------------------------------------------------------------- curves */

/* Where curves go, and the arc that they are part of. */
typedef struct making {
  celspan_context *context;
  cs_parcels *parcels;
  cs_frame_sides *sides;
  cs_parcel_arc arc;
} making;

static celspan_point scaled(const making *m, celspan_point at) {
  double x = at.x < 0 ? 0 : at.x > SIDE ? SIDE : at.x;
  return (celspan_point){x / SIDE * m->parcels->width, at.y / SIDE * m->parcels->height};
}

static celspan_status append(const making *m, bool is_line, const celspan_point points[4]) {
  cs_parcel_curve curve = {.is_line = is_line};
  for (int i = 0; i < 4; i++)
    curve.points[i] = scaled(m, points[i]);
  return CS_ARRAY_APPEND(m->context, m->parcels->curves, m->parcels->curve_count, curve);
}

static celspan_status append_line(const making *m, celspan_point from, celspan_point to) {
  return append(m, true, (const celspan_point[4]){from, from, to, to});
}

/* The control point of a curve that leaves its end, or comes to it, as another curve does. */
static celspan_point tangent(const bend *curve, bool is_end) {
  int at = is_end ? curve->degree : 0, next = is_end ? at - 1 : 1;
  celspan_point end = cs_hpoint_place(curve->points[at]),
                control = cs_hpoint_place(curve->points[next]);
  double share = curve->points[next].w / curve->points[at].w * curve->degree / 3;
  return (celspan_point){end.x + share * (control.x - end.x), end.y + share * (control.y - end.y)};
}

/* A rational curve of degree 2 is a conic: its weights count by their ratio alone, and the cubic
 * curve has its middle, too. */
static double conic_share(const bend *curve) {
  double w = curve->points[1].w / sqrt(curve->points[0].w * curve->points[2].w);
  return 4 * w / (3 * (1 + w));
}

static bend cubic_of(const bend *curve) {
  bend out = {.degree = 3};
  celspan_point points[4] = {cs_hpoint_place(curve->points[0]), tangent(curve, false),
                             tangent(curve, true), end_of(curve)};
  if (curve->is_rational && curve->degree == 2) {
    celspan_point control = cs_hpoint_place(curve->points[1]);
    double share = conic_share(curve);
    for (int i = 1; i < 3; i++) {
      celspan_point end = points[i == 1 ? 0 : 3];
      points[i].x = end.x + share * (control.x - end.x);
      points[i].y = end.y + share * (control.y - end.y);
    }
  }
  for (int i = 0; i < 4; i++)
    out.points[i] = (cs_hpoint){points[i].x, points[i].y, 1};
  return out;
}

/* Whether two curves are near each other, at a quarter and three quarters of their height. */
static bool are_alike(const bend *a, const bend *b) {
  double top = cs_hpoint_place(a->points[0]).y, foot = end_of(a).y;
  for (int i = 1; i < 4; i += 2) {
    bend first[2];
    double y = top + (foot - top) * i / 4;
    cut(a, find_root(a, true, y), &first[0], NULL);
    cut(b, find_root(b, true, y), &first[1], NULL);
    if (fabs(end_of(&first[0]).x - end_of(&first[1]).x) > GOOD)
      return false;
  }
  return true;
}

/* ---------------------------------------------------------------- the frame's sides */

/* The side that a curve crosses between its ends; NAN: none. */
static double crossed_side(const bend *curve) {
  double a = cs_hpoint_place(curve->points[0]).x, b = end_of(curve).x;
  for (int i = 0; i < 2; i++) {
    double side = i * SIDE;
    if ((a < side && b > side) || (a > side && b < side))
      return side;
  }
  return NAN;
}

/* Whether all of a curve is within the frame, *outside: or beyond one of its sides. */
static bool is_within(const bend *curve, bool *outside) {
  double least = INFINITY, most = -INFINITY;
  for (int i = 0; i <= curve->degree; i++) {
    least = fmin(least, cs_hpoint_place(curve->points[i]).x);
    most = fmax(most, cs_hpoint_place(curve->points[i]).x);
  }
  *outside = most <= 0 || least >= SIDE;
  return least >= 0 && most <= SIDE;
}

celspan_status cs_arc_refuse(celspan_context *context) {
  return cs_fail(context, CELSPAN_LIMIT,
                 "there are more than %d borders between what is visible, too many for vectors: "
                 "write a picture, or a smaller part",
                 CS_PARCEL_ARCS);
}

/* Ends the arc at a height. */
static celspan_status end_arc(making *m, int32_t height) {
  cs_parcels *parcels = m->parcels;
  cs_parcel_arc arc = m->arc;
  m->arc.top = height;
  m->arc.curve = parcels->curve_count;
  arc.foot = height;
  arc.curve_count = parcels->curve_count - arc.curve;
  if (arc.curve_count == 0)
    return CELSPAN_OK;
  /* weights have rounded them */
  parcels->curves[arc.curve].points[0].y = arc.top / SIDE * parcels->height;
  parcels->curves[parcels->curve_count - 1].points[3].y = arc.foot / SIDE * parcels->height;
  if (parcels->arc_count == CS_PARCEL_ARCS)
    return cs_arc_refuse(m->context);
  return CS_ARRAY_APPEND(m->context, parcels->arcs, parcels->arc_count, arc);
}

/* The arc leaves the frame with a curve, and comes back at its end, or later. */
static celspan_status put_outside(making *m, const bend *curve) {
  celspan_point begin = cs_hpoint_place(curve->points[0]), end = end_of(curve);
  int32_t foot = (int32_t)(end.y + 0.5);
  CS_TRY(end_arc(m, (int32_t)(begin.y + 0.5)));
  CS_TRY(cs_sides_add(m->context, m->sides, begin.x + end.x > SIDE, m->arc.top, foot, m->arc.left,
                      m->arc.right));
  m->arc.top = foot;
  return CELSPAN_OK;
}

/* A curve that is not rational. */
static celspan_status put_within(making *m, const bend *curve, int halvings) {
  bool outside;
  celspan_point points[4];
  if (is_within(curve, &outside) || outside || halvings == 0) {
    for (int i = 0; i <= curve->degree; i++)
      points[i] = cs_hpoint_place(curve->points[i]);
    return outside              ? put_outside(m, curve)
           : curve->degree == 1 ? append_line(m, points[0], points[1])
                                : append(m, false, points);
  }
  bend halves[2];
  double side = crossed_side(curve);
  cut(curve, isnan(side) ? 0.5 : find_root(curve, false, side), &halves[0], &halves[1]);
  if (!isnan(side)) {
    celspan_point at = {side, end_of(&halves[0]).y};
    set_end(&halves[0], curve->degree, at);
    set_end(&halves[1], 0, at);
  }
  CS_TRY(put_within(m, &halves[0], halvings - 1));
  return put_within(m, &halves[1], halvings - 1);
}

static celspan_status put(making *m, const bend *curve, int halvings) {
  bend cubic;
  if (curve->degree == 1)
    return put_within(m, curve, SIDE_HALVINGS);
  cubic = cubic_of(curve);
  if (!curve->is_rational || halvings == 0 || are_alike(curve, &cubic))
    return put_within(m, &cubic, SIDE_HALVINGS);
  bend halves[2];
  cut(curve, 0.5, &halves[0], &halves[1]);
  CS_TRY(put(m, &halves[0], halvings - 1));
  return put(m, &halves[1], halvings - 1);
}

/* ---------------------------------------------------------------- arcs */

static celspan_status put_pieces(making *m, const planefile_band *band,
                                 const planefile_border *border) {
  const planefile_chain *chain = &band->chains[border->chain];
  for (uint32_t i = 0; i < chain->piece_count; i++) {
    bend curve = bend_of(band, &band->pieces[chain->piece + i]);
    if (end_of(&curve).y <= border->top || cs_hpoint_place(curve.points[0]).y >= border->foot)
      continue;
    cut_heights(&curve, border->top, border->foot);
    CS_TRY(put(m, &curve, HALVINGS));
  }
  return CELSPAN_OK;
}

celspan_status cs_arc_put(celspan_context *context, const planefile_band *band,
                          const planefile_border *border, uint32_t left, uint32_t right,
                          cs_frame_sides *sides, cs_parcels *parcels) {
  making m = {context, parcels, sides, {parcels->curve_count, 0, left, right, border->top, 0}};
  CS_TRY(put_pieces(&m, band, border));
  return end_arc(&m, border->foot);
}

celspan_status cs_arc_put_side(celspan_context *context, int side, int32_t top, int32_t foot,
                               uint32_t fill, cs_parcels *parcels) {
  making m = {.context = context, .parcels = parcels};
  m.arc =
      (cs_parcel_arc){parcels->curve_count, 0, side > 0 ? fill : 0, side > 0 ? 0 : fill, top, 0};
  CS_TRY(append_line(&m, (celspan_point){side * SIDE, top}, (celspan_point){side * SIDE, foot}));
  return end_arc(&m, foot);
}
