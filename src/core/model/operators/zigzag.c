/* Zigzag: every piece of a contour gets ridges, points that lie on the two sides of it in turn.
 *
 *        *       *             ridges = 3: points at 1/4, 1/2 and 3/4 of the parameter, and at the
 *    ---/-\-----/-\---- piece  joints, where the direction is that from the joint before to the
 *   *      \   /    \          joint after. smooth: the points are joined by curves along the piece
 *            *       *
 */

#include "base/number.h"
#include "celspan/operators.h"
#include "model/operators/operate.h"
#include "model/scene/check.h"
#include "model/stroke/curve.h"

#define RIDGES_MOST 10000
#define POINTS_MOST 1000000 /* points of one object */

typedef struct zigzag {
  cs_operation operation;
  double size;
  size_t ridges, points;
  bool is_smooth;
} zigzag;

/* A point of the new contour, with the control points before and after it. */
typedef struct ridge {
  celspan_point in, at, out;
} ridge;

/* The new contour, while it is written. */
typedef struct maker {
  const zigzag *z;
  cs_lines *to;
  double size; /* in own units; its sign: the side of the next point */
  ridge first, last;
  size_t count;
} maker;

static double distance(celspan_point a, celspan_point b) {
  return cs_number_length(b.x - a.x, b.y - a.y);
}

static celspan_status join(const maker *p, const ridge *to) {
  celspan_context *context = p->z->operation.context;
  const cs_hpoint end = {to->at.x, to->at.y, 1};
  if (!p->z->is_smooth)
    return cs_outline_line(context, &p->to->outline, end);
  const cs_bezier curve = {3,
                           {{p->last.at.x, p->last.at.y, 1},
                            {p->last.out.x, p->last.out.y, 1},
                            {to->in.x, to->in.y, 1},
                            end}};
  return cs_lines_add(context, p->to, &curve);
}

/* A point beside a place. direction: of the line there. in, out: lengths of the control arms. */
static celspan_status put(maker *p, celspan_point place, celspan_point direction, double in,
                          double out) {
  double length = cs_number_length(direction.x, direction.y);
  double x = length > 0 ? direction.x / length : 0, y = length > 0 ? direction.y / length : 0;
  celspan_point at = {place.x + p->size * y, place.y - p->size * x};
  const ridge made = {{at.x - in * x, at.y - in * y}, at, {at.x + out * x, at.y + out * y}};
  if (p->count == 0)
    CS_TRY(cs_lines_begin(p->z->operation.context, p->to, (cs_hpoint){at.x, at.y, 1}));
  else
    CS_TRY(join(p, &made));
  if (p->count++ == 0)
    p->first = made;
  p->last = made;
  p->size = -p->size;
  return CELSPAN_OK;
}

static double arm(const maker *p, double side) { return side / (2 * ((double)p->z->ridges + 1)); }

static celspan_status put_ridges(maker *p, const cs_bezier *piece) {
  double side =
      distance(cs_hpoint_place(piece->points[0]), cs_hpoint_place(piece->points[piece->degree]));
  for (size_t i = 1; i <= p->z->ridges; i++) {
    celspan_point point, direction;
    cs_curve_line_at(piece, (double)i / (double)(p->z->ridges + 1), &point, &direction);
    CS_TRY(put(p, point, direction, arm(p, side), arm(p, side)));
  }
  return CELSPAN_OK;
}

/* The joint at the beginning of piece `i`, or at the end of the contour. */
static celspan_point joint(const cs_lines *lines, const cs_lines_contour *contour, size_t i) {
  cs_bezier piece;
  size_t count = contour->end - contour->begin;
  bool is_last = i == contour->end && !contour->is_closed;
  cs_lines_load(lines, is_last ? i - 1 : contour->begin + (i - contour->begin) % count, &piece);
  return cs_hpoint_place(piece.points[is_last ? piece.degree : 0]);
}

static celspan_status put_joint(maker *p, const cs_lines *lines, const cs_lines_contour *contour,
                                size_t i) {
  size_t count = contour->end - contour->begin;
  celspan_point at = joint(lines, contour, i), before = at, after = at;
  if (contour->is_closed || i > contour->begin)
    before = joint(lines, contour, i > contour->begin ? i - 1 : i + count - 1);
  if (contour->is_closed || i < contour->end)
    after = joint(lines, contour, i + 1);
  return put(p, at, (celspan_point){after.x - before.x, after.y - before.y},
             arm(p, distance(before, at)), arm(p, distance(at, after)));
}

/* Once round, the last point is the first one, unless it lies on the other side. */
static celspan_status close(maker *p, const cs_lines *lines, const cs_lines_contour *contour) {
  if (p->count % 2 == 1)
    CS_TRY(put_joint(p, lines, contour, contour->end));
  CS_TRY(join(p, &p->first));
  return cs_lines_end(p->z->operation.context, p->to, true);
}

static celspan_status change_contour(zigzag *z, const cs_lines *lines,
                                     const cs_lines_contour *contour, double size, cs_lines *to) {
  maker p = {.z = z, .to = to, .size = -size};
  cs_bezier piece;
  z->points += (contour->end - contour->begin) * (z->ridges + 1);
  if (z->points > POINTS_MOST)
    return cs_fail(z->operation.context, CELSPAN_LIMIT,
                   "zigzag: the object would have more than %d points; give it fewer ridges",
                   POINTS_MOST);
  for (size_t i = contour->begin; i < contour->end; i++) {
    cs_lines_load(lines, i, &piece);
    CS_TRY(put_joint(&p, lines, contour, i));
    CS_TRY(put_ridges(&p, &piece));
  }
  return contour->is_closed ? close(&p, lines, contour)
                            : put_joint(&p, lines, contour, contour->end);
}

static celspan_status change(cs_operation *operation, const cs_lines *from,
                             const celspan_matrix *place, double scale, cs_lines *to) {
  (void)place;
  zigzag *z = (zigzag *)operation;
  size_t closed_at = 0;
  for (size_t i = 0; i < from->outline.contour_count; i++) {
    const cs_lines_contour contour = cs_lines_contour_at(from, i, &closed_at);
    CS_TRY(change_contour(z, from, &contour, z->size / scale, to));
  }
  return CELSPAN_OK;
}

celspan_status celspan_object_zigzag(celspan_context *context, celspan_object *object, double size,
                                     size_t ridges, bool is_smooth, celspan_object **out) {
  CS_TRY(cs_check_given(context, "zigzag", "the object", object));
  CS_TRY(cs_check_number(context, "zigzag", "size", size));
  CS_TRY(cs_check_range(context, "zigzag", "ridges", (double)ridges, 0, RIDGES_MOST));
  zigzag z = {.operation = {context, "zigzag", change},
              .size = size,
              .ridges = ridges,
              .is_smooth = is_smooth};
  return cs_operate(&z.operation, object, out);
}
