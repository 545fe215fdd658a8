#include <math.h>

#include "geometry/bezier.h"
#include "geometry/matrix.h"
#include "geometry/outline.h"

typedef struct extent {
  double left, top, right, bottom;
} extent;

static void include_point(extent *box, cs_hpoint point) {
  double x = point.x / point.w, y = point.y / point.w;
  box->left = fmin(box->left, x);
  box->right = fmax(box->right, x);
  box->top = fmin(box->top, y);
  box->bottom = fmax(box->bottom, y);
}

static void include_extrema(extent *box, const cs_bezier *curve, cs_bezier_axis axis) {
  double roots[CS_BEZIER_ROOTS];
  int count = cs_bezier_extrema(curve, axis, roots);
  for (int i = 0; i < count; i++) {
    cs_bezier low, high;
    cs_bezier_split(curve, roots[i], &low, &high);
    include_point(box, high.points[0]);
  }
}

static celspan_status include_curve(void *user, const cs_bezier *curve) {
  extent *box = user, hull;
  include_point(box, curve->points[0]);
  include_point(box, curve->points[curve->degree]);
  hull = *box;
  for (int i = 1; i < curve->degree; i++)
    include_point(&hull, curve->points[i]);
  if (hull.left < box->left || hull.right > box->right)
    include_extrema(box, curve, CS_BEZIER_X);
  if (hull.top < box->top || hull.bottom > box->bottom)
    include_extrema(box, curve, CS_BEZIER_Y);
  return CELSPAN_OK;
}

bool cs_outline_bounds(const cs_outline *outline, const celspan_matrix *matrix, celspan_box *out) {
  extent box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  celspan_matrix facing = cs_matrix_facing(matrix);
  double least;
  if (!cs_bezier_horizon(outline, &facing, &least))
    return false;
  for (size_t i = 0; i < outline->piece_count; i++) {
    cs_bezier curve;
    cs_bezier_load(outline, i, &facing, &curve);
    if (cs_bezier_clip(&curve, least, include_curve, &box) != CELSPAN_OK)
      return false;
  }
  if (!(box.left <= box.right))
    return false;
  *out = (celspan_box){box.left, box.top, box.right - box.left, box.bottom - box.top};
  return true;
}
