#include "model/scene/inside.h"

#include "model/geometry/matrix.h"

#define MAX_DEGREE 15
/* How many times a piece is halved before its chord decides: more would not change a double. */
#define MAX_HALVINGS 56

/* Control points relative to the point that is tested, times their weights w > 0: u < 0 is left of
 * the point, v < 0 above it. */
typedef struct offsets {
  double u[MAX_DEGREE + 1], v[MAX_DEGREE + 1];
} offsets;

/* The half-open rule: a piece from above the height (height included) to below it counts +1. */
static int direction(double from, double to) { return (from <= 0) - (to <= 0); }

static bool chord_is_left(const offsets *p, int last) {
  double cross = p->u[0] * p->v[last] - p->u[last] * p->v[0];
  return p->v[last] > p->v[0] ? cross <= 0 : cross >= 0;
}

/* The signed crossings of a Bezier piece with the ray to the left. The curve lies in the convex
 * hull of its control points; only a piece whose hull contains the point must be halved. */
static int crossings(const offsets *points, int degree, int halvings) {
  int left = 0, above = 0;
  for (int i = 0; i <= degree; i++) {
    left += points->u[i] <= 0;
    above += points->v[i] <= 0;
  }
  if (left == 0 || above == 0 || above == degree + 1)
    return 0;
  int net = direction(points->v[0], points->v[degree]);
  if (left == degree + 1)
    return net;
  if (degree == 1 || halvings == MAX_HALVINGS)
    return net != 0 && chord_is_left(points, degree) ? net : 0;
  offsets low, high;
  cs_inside_halve(points->u, degree, low.u, high.u);
  cs_inside_halve(points->v, degree, low.v, high.v);
  return crossings(&low, degree, halvings + 1) + crossings(&high, degree, halvings + 1);
}

bool cs_inside_outline(const cs_outline *outline, celspan_rule rule, celspan_point point) {
  int winding = 0;
  for (size_t i = 0; i < outline->piece_count; i++) {
    const cs_hpoint *at = outline->points + outline->starts[i];
    int degree = outline->degrees[i];
    offsets points;
    for (int k = 0; k <= degree; k++) {
      points.u[k] = at[k].x - point.x * at[k].w;
      points.v[k] = at[k].y - point.y * at[k].w;
    }
    winding += crossings(&points, degree, 0);
  }
  return rule == CELSPAN_RULE_EVENODD ? winding % 2 != 0 : winding != 0;
}

bool cs_inside_own_point(const celspan_matrix *matrix, celspan_point point, celspan_point *out) {
  celspan_matrix inverse;
  if (!celspan_matrix_inverse(cs_matrix_facing(matrix), &inverse))
    return false;
  cs_hpoint below = cs_matrix_apply(&inverse, (cs_hpoint){point.x, point.y, 1});
  if (!(below.w > 0))
    return false;
  *out = (celspan_point){below.x / below.w, below.y / below.w};
  return true;
}

/* The recursion ends because nesting is at most CS_SCENE_DEPTH. */
static bool inside_object(const celspan_object *object, const celspan_matrix *parent,
                          celspan_point point) {
  const cs_primitive_data *data = object->data;
  const celspan_matrix whole = celspan_matrix_then(*object->matrix, *parent);
  celspan_point own;
  if (data->is_empty)
    return false;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return cs_inside_own_point(&whole, point, &own) && cs_inside_primitive(data, own);
  size_t present = 0;
  bool first = false;
  for (size_t i = 0; i < data->boolean->operand_count; i++) {
    bool is_present = inside_object(data->boolean->operands[i], &whole, point);
    present += is_present;
    first = first || (i == 0 && is_present);
  }
  return cs_inside_is_present(data->boolean->op, present, data->boolean->operand_count, first);
}

bool celspan_object_contains(const celspan_object *object, celspan_point point) {
  const celspan_matrix identity = celspan_matrix_identity();
  return inside_object(object, &identity, point);
}

bool celspan_cel_contains(const celspan_cel *cel, celspan_point point) {
  for (size_t i = 0; i < cel->object_count; i++)
    if (inside_object(cel->objects[i], &cel->matrix, point))
      return true;
  return false;
}
