/* Pucker and bloat: joints move towards the middle of their contour, and control points away from
 * it, or the other way round. The side of a polygon has its control points at its ends.
 *
 *   a square      bloated, 0.3       puckered, -0.3
 *                     .--.            *.      .*
 *    *----*          (    )             ')  ('
 *    |    |         (  *  *  )  ...      )  (
 *    *----*          (    )            .'    '.
 *                     '--'            *        *
 */
#include <math.h>

#include "celspan/operators.h"
#include "model/operators/operate.h"
#include "model/scene/check.h"

typedef struct pucker {
  cs_operation operation;
  double amount;
} pucker;

static celspan_point between(celspan_point a, celspan_point b, double u) {
  return (celspan_point){a.x + u * (b.x - a.x), a.y + u * (b.y - a.y)};
}

/* How far along its sides the control points of the cubic lie that stands for a piece of degree 2:
 * it is exact for equal weights, and has the same middle as an arc of a conic. */
static double arm_of(const cs_bezier *piece) {
  double w = piece->points[1].w / sqrt(piece->points[0].w * piece->points[2].w);
  return 4 * w / (3 * (1 + w));
}

/* The piece as a cubic. Pieces of higher degrees keep their ends and their directions there. */
static void read_cubic(const cs_bezier *piece, celspan_point cubic[4]) {
  int degree = piece->degree;
  celspan_point a = cs_hpoint_place(piece->points[0]), b = cs_hpoint_place(piece->points[degree]);
  cubic[0] = cubic[1] = a;
  cubic[2] = cubic[3] = b;
  if (degree < 2)
    return;
  double arm = degree == 2 ? arm_of(piece) : degree / 3.0;
  cubic[1] = between(a, cs_hpoint_place(piece->points[1]), arm);
  cubic[2] = between(b, cs_hpoint_place(piece->points[degree - 1]), arm);
}

/* The mean of the joints. */
static celspan_point middle_of(const cs_lines *lines, const cs_lines_contour *contour) {
  celspan_point sum = {0, 0};
  double count = 0;
  cs_bezier piece;
  for (size_t i = contour->begin; i < contour->end; i++) {
    cs_lines_load(lines, i, &piece);
    bool is_end = i + 1 == contour->end && !contour->is_closed;
    for (int k = 0; k <= (is_end ? piece.degree : 0); k += piece.degree) {
      celspan_point p = cs_hpoint_place(piece.points[k]);
      sum = (celspan_point){sum.x + p.x, sum.y + p.y};
      count++;
    }
  }
  return (celspan_point){sum.x / count, sum.y / count};
}

static celspan_status change_contour(const pucker *p, const cs_lines *lines,
                                     const cs_lines_contour *contour, cs_lines *to) {
  celspan_context *context = p->operation.context;
  const celspan_point middle = middle_of(lines, contour);
  cs_bezier piece;
  for (size_t i = contour->begin; i < contour->end; i++) {
    celspan_point cubic[4];
    cs_lines_load(lines, i, &piece);
    read_cubic(&piece, cubic);
    cs_bezier moved = {.degree = 3};
    for (int k = 0; k < 4; k++)
      moved.points[k] =
          cs_hpoint_of(between(cubic[k], middle, k == 0 || k == 3 ? p->amount : -p->amount));
    if (i == contour->begin)
      CS_TRY(cs_lines_begin(context, to, moved.points[0]));
    CS_TRY(cs_lines_add(context, to, &moved));
  }
  return cs_lines_end(context, to, contour->is_closed);
}

static celspan_status change(cs_operation *operation, const cs_lines *from,
                             const celspan_matrix *place, double scale, cs_lines *to) {
  (void)place, (void)scale;
  size_t closed_at = 0;
  for (size_t i = 0; i < from->outline.contour_count; i++) {
    const cs_lines_contour contour = cs_lines_contour_at(from, i, &closed_at);
    CS_TRY(change_contour((const pucker *)operation, from, &contour, to));
  }
  return CELSPAN_OK;
}

celspan_status celspan_object_pucker(celspan_context *context, celspan_object *object,
                                     double amount, celspan_object **out) {
  CS_TRY(cs_check_given(context, "pucker", "the object", object));
  CS_TRY(cs_check_range(context, "pucker", "amount", amount, -1, 1));
  pucker p = {.operation = {context, "pucker", change}, .amount = amount};
  return cs_operate(&p.operation, object, out);
}
