/* The box around an outline. */
#include <math.h>

#include "model/geometry/matrix.h"
#include "model/geometry/plain.h"

typedef cs_plain_hull extent;

static void include(extent *box, cs_pair point) {
  box->least = cs_pair_least(box->least, point);
  box->most = cs_pair_most(box->most, point);
}

/* Whether a hull extends beyond the box to the left or right, or upwards or downwards. */
static bool extends(const extent *box, const cs_plain_hull *hull, cs_bezier_axis axis) {
  int i = axis == CS_BEZIER_X ? 0 : 1;
  return hull->least[i] < box->least[i] || hull->most[i] > box->most[i];
}

/* ---------------------------------------------------------------- any pieces */

static cs_pair project(cs_hpoint point) { return cs_pair_load(&point) / point.w; }

static void include_extrema(extent *box, const cs_bezier *curve, cs_bezier_axis axis) {
  double roots[CS_BEZIER_ROOTS];
  int count = cs_bezier_extrema(curve, axis, roots);
  for (int i = 0; i < count; i++) {
    cs_bezier low, high;
    cs_bezier_split(curve, roots[i], &low, &high);
    include(box, project(high.points[0]));
  }
}

static celspan_status include_curve(void *user, const cs_bezier *curve) {
  extent *box = user, hull;
  include(box, project(curve->points[0]));
  include(box, project(curve->points[curve->degree]));
  hull = *box;
  for (int i = 1; i < curve->degree; i++)
    include(&hull, project(curve->points[i]));
  if (extends(box, &hull, CS_BEZIER_X))
    include_extrema(box, curve, CS_BEZIER_X);
  if (extends(box, &hull, CS_BEZIER_Y))
    include_extrema(box, curve, CS_BEZIER_Y);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- plain pieces */

static void include_plain_extrema(extent *box, const cs_plain *curve, cs_bezier_axis axis) {
  double roots[CS_PLAIN_DEGREE];
  int count = cs_plain_extrema(curve, axis, roots);
  for (int i = 0; i < count; i++)
    include(box, cs_plain_at(curve, roots[i]));
}

static void include_plain(extent *box, const cs_plain *curve) {
  cs_plain_hull hull = cs_plain_hull_of(curve);
  include(box, curve->points[0]);
  include(box, curve->points[CS_PLAIN_DEGREE]);
  if (extends(box, &hull, CS_BEZIER_X))
    include_plain_extrema(box, curve, CS_BEZIER_X);
  if (extends(box, &hull, CS_BEZIER_Y))
    include_plain_extrema(box, curve, CS_BEZIER_Y);
}

static void include_plain_outline(extent *box, const cs_outline *outline,
                                  const celspan_matrix *matrix) {
  const cs_plain_map map = cs_plain_map_of(matrix);
  for (size_t i = 0; i < outline->piece_count; i++) {
    const cs_hpoint *points = outline->points + outline->starts[i];
    cs_plain curve;
    cs_plain_load(&curve, cs_plain_place(&map, points), points + 1, outline->degrees[i], &map);
    include_plain(box, &curve);
  }
}

/* ---------------------------------------------------------------- outlines */

static bool include_outline(extent *box, const cs_outline *outline, const celspan_matrix *matrix,
                            double least) {
  for (size_t i = 0; i < outline->piece_count; i++) {
    cs_bezier curve;
    cs_bezier_load(outline, i, matrix, &curve);
    if (cs_bezier_clip(&curve, least, include_curve, box) != CELSPAN_OK)
      return false;
  }
  return true;
}

bool cs_outline_bounds(const cs_outline *outline, const celspan_matrix *matrix, celspan_box *out) {
  extent box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
  celspan_matrix facing = cs_matrix_facing(matrix);
  double least;
  if (!cs_bezier_horizon(outline, &facing, &least))
    return false;
  if (cs_plain_applies(outline, &facing))
    include_plain_outline(&box, outline, &facing);
  else if (!include_outline(&box, outline, &facing, least))
    return false;
  if (!(box.least[0] <= box.most[0]))
    return false;
  cs_pair size = box.most - box.least;
  *out = (celspan_box){box.least[0], box.least[1], size[0], size[1]};
  return true;
}

celspan_box cs_outline_box_around(celspan_box a, celspan_box b) {
  double x = fmin(a.x, b.x), y = fmin(a.y, b.y);
  return (celspan_box){x, y, fmax(a.x + a.width, b.x + b.width) - x,
                       fmax(a.y + a.height, b.y + b.height) - y};
}
