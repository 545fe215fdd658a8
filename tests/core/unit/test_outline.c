/* Primitive outlines: their invariants, their shapes, their boxes. */
#include "model/geometry/bezier.h"
#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static celspan_context *context;
static const double pi = 3.14159265358979323846;

static bool is_closed(const cs_outline *outline) {
  for (size_t c = 0; c < outline->contour_count; c++) {
    size_t begin = outline->contours[c];
    size_t end = c + 1 < outline->contour_count ? outline->contours[c + 1] : outline->piece_count;
    size_t last = outline->starts[end - 1] + (size_t)outline->degrees[end - 1];
    if (memcmp(&outline->points[outline->starts[begin]], &outline->points[last],
               sizeof *outline->points) != 0)
      return false;
    for (size_t i = begin; i + 1 < end; i++)
      if (outline->starts[i + 1] != outline->starts[i] + outline->degrees[i])
        return false;
  }
  return true;
}

static celspan_point at(const cs_outline *outline, size_t piece, double t) {
  celspan_matrix none = celspan_matrix_identity();
  cs_bezier curve, low, high;
  cs_bezier_load(outline, piece, &none, &curve);
  cs_bezier_split(&curve, t, &low, &high);
  return (celspan_point){high.points[0].x / high.points[0].w, high.points[0].y / high.points[0].w};
}

static void check_box(const cs_outline *outline, const celspan_matrix *matrix, double left,
                      double top, double right, double bottom, double tolerance) {
  celspan_box box;
  if (!CHECK(cs_outline_bounds(outline, matrix, &box)))
    return;
  CHECK_NEAR(box.x, left, tolerance);
  CHECK_NEAR(box.y, top, tolerance);
  CHECK_NEAR(box.x + box.width, right, tolerance);
  CHECK_NEAR(box.y + box.height, bottom, tolerance);
}

static void a_rectangle_has_four_lines(void) {
  cs_outline outline;
  celspan_matrix none = celspan_matrix_identity();
  cs_outline_init(&outline);
  CHECK(cs_outline_rect(context, &outline, 10, 20, 30, 40, 0) == CELSPAN_OK);
  CHECK(outline.piece_count == 4 && outline.contour_count == 1 && is_closed(&outline));
  check_box(&outline, &none, 10, 20, 40, 60, 0);
  cs_outline_finish(&outline, context->memory);
}

static void rounded_corners_are_circles(void) {
  cs_outline outline;
  celspan_matrix none = celspan_matrix_identity();
  cs_outline_init(&outline);
  CHECK(cs_outline_rect(context, &outline, 10, 20, 300, 200, 50) == CELSPAN_OK);
  CHECK(outline.piece_count == 8 && is_closed(&outline));
  for (size_t i = 0; i < 8; i++)
    for (double t = 0; outline.degrees[i] == 2 && t <= 1; t += 0.125) {
      celspan_point p = at(&outline, i, t);
      double centre_x = p.x < 160 ? 60 : 260, centre_y = p.y < 120 ? 70 : 170;
      CHECK_NEAR(hypot(p.x - centre_x, p.y - centre_y), 50, 1e-11);
    }
  check_box(&outline, &none, 10, 20, 310, 220, 1e-12);
  cs_outline_finish(&outline, context->memory);
  /* A radius beyond half the shorter side is that half. */
  CHECK(cs_outline_rect(context, &outline, 0, 0, 100, 40, 1000) == CELSPAN_OK);
  CHECK(is_closed(&outline));
  check_box(&outline, &none, 0, 0, 100, 40, 1e-12);
  cs_outline_finish(&outline, context->memory);
}

static void an_ellipse_keeps_its_equation(void) {
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_ellipse(context, &outline, (celspan_point){7, -3}, 40, 25) == CELSPAN_OK);
  CHECK(outline.piece_count == 4 && is_closed(&outline));
  for (size_t i = 0; i < 4; i++)
    for (double t = 0; t <= 1; t += 0.0625) {
      celspan_point p = at(&outline, i, t);
      CHECK_NEAR(hypot((p.x - 7) / 40, (p.y + 3) / 25), 1, 1e-14);
    }
  cs_outline_finish(&outline, context->memory);
}

static void boxes_are_tight_when_turned(void) {
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_ellipse(context, &outline, (celspan_point){0, 0}, 40, 20) == CELSPAN_OK);
  for (int i = 0; i < 20; i++) {
    double angle = i * pi / 10, c = cos(angle), s = sin(angle);
    celspan_matrix turned = celspan_matrix_rotation(angle, (celspan_point){0, 0});
    double half_x = sqrt(1600 * c * c + 400 * s * s), half_y = sqrt(1600 * s * s + 400 * c * c);
    check_box(&outline, &turned, -half_x, -half_y, half_x, half_y, 1e-10);
  }
  cs_outline_finish(&outline, context->memory);
}

/* Against many samples: none is outside, and they reach all sides. */
static void boxes_are_tight_in_perspective(void) {
  for (int seed = 1; seed <= 100; seed++) {
    test_random random = {(uint64_t)seed};
    celspan_point points[7];
    double weights[7];
    for (int i = 0; i < 7; i++) {
      points[i] = random_point(&random, 0, 100, 0, 100);
      weights[i] = random_between(&random, 0.1, 5);
    }
    celspan_nurbs_desc desc = {.struct_size = sizeof desc,
                               .points = points,
                               .weights = weights,
                               .point_count = 7,
                               .degree = 4};
    cs_outline outline;
    cs_outline_init(&outline);
    CHECK(cs_outline_nurbs(context, &outline, &desc) == CELSPAN_OK);
    celspan_matrix matrix = {{2, 0.5, 3, -0.4, 1.5, 8, 0.003, -0.002, 1}};
    double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
    for (size_t i = 0; i < outline.piece_count; i++)
      for (int k = 0; k <= 2000; k++) {
        celspan_point p = at(&outline, i, k / 2000.0);
        cs_hpoint h = cs_matrix_apply(&matrix, (cs_hpoint){p.x, p.y, 1});
        left = fmin(left, h.x / h.w);
        right = fmax(right, h.x / h.w);
        top = fmin(top, h.y / h.w);
        bottom = fmax(bottom, h.y / h.w);
      }
    celspan_box box;
    CHECK(cs_outline_bounds(&outline, &matrix, &box));
    CHECK(box.x <= left + 1e-9 && box.y <= top + 1e-9);
    CHECK(box.x + box.width >= right - 1e-9 && box.y + box.height >= bottom - 1e-9);
    check_box(&outline, &matrix, left, top, right, bottom, 1e-3);
    cs_outline_finish(&outline, context->memory);
  }
}

static void contours_without_pieces_vanish(void) {
  cs_outline outline;
  celspan_box box;
  celspan_matrix none = celspan_matrix_identity();
  cs_outline_init(&outline);
  CHECK(cs_outline_move(context, &outline, (cs_hpoint){1, 2, 1}) == CELSPAN_OK);
  CHECK(cs_outline_move(context, &outline, (cs_hpoint){3, 4, 1}) == CELSPAN_OK);
  CHECK(cs_outline_close(context, &outline) == CELSPAN_OK);
  CHECK(cs_outline_close(context, &outline) == CELSPAN_OK);
  CHECK(outline.contour_count == 0 && outline.point_count == 0);
  CHECK(!cs_outline_bounds(&outline, &none, &box));
  CHECK(cs_outline_move(context, &outline, (cs_hpoint){0.0, 0, 1}) == CELSPAN_OK);
  CHECK(cs_outline_line(context, &outline, (cs_hpoint){5, 0, 1}) == CELSPAN_OK);
  CHECK(cs_outline_line(context, &outline, (cs_hpoint){5, 5, 1}) == CELSPAN_OK);
  CHECK(cs_outline_line(context, &outline, (cs_hpoint){-0.0, 0, 1}) == CELSPAN_OK);
  CHECK(cs_outline_close(context, &outline) == CELSPAN_OK);
  CHECK(outline.piece_count == 3 && is_closed(&outline)); /* -0 became the 0 of the beginning */
  cs_outline_finish(&outline, context->memory);
}

static void roots_are_found_where_signs_change(void) {
  /* y = (t - 1/4)(t - 1/2)(t - 3/4) as a cubic; the middle root falls on the first halving. */
  cs_bezier curve = {
      .degree = 3,
      .points = {{0, -3.0 / 32, 1}, {0, 13.0 / 96, 1}, {0, -13.0 / 96, 1}, {0, 3.0 / 32, 1}}};
  double roots[CS_BEZIER_ROOTS];
  int count = cs_bezier_crossings(&curve, (cs_bezier_form){.y = 1}, roots);
  CHECK(count == 3);
  for (int i = 0; i < count; i++)
    CHECK_NEAR(roots[i], 0.25 * (i + 1), 1e-14);
  CHECK(cs_bezier_extrema(&curve, CS_BEZIER_Y, roots) == 2);
  CHECK_NEAR(roots[0], 0.5 - sqrt(1.0 / 48), 1e-12);
  /* A line that is touched, or coincident, is not crossed. */
  cs_bezier touching = {.degree = 2, .points = {{0, 1, 1}, {1, -1, 1}, {2, 1, 1}}};
  CHECK(cs_bezier_crossings(&touching, (cs_bezier_form){.y = 1}, roots) != 1);
  cs_bezier flat = {.degree = 3, .points = {{0, 0.3, 1}, {1, 0.3, 1}, {2, 0.3, 1}, {3, 0.3, 1}}};
  CHECK(cs_bezier_crossings(&flat, (cs_bezier_form){.y = 1, .w = -0.3}, roots) == 0);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  a_rectangle_has_four_lines();
  rounded_corners_are_circles();
  an_ellipse_keeps_its_equation();
  boxes_are_tight_when_turned();
  boxes_are_tight_in_perspective();
  contours_without_pieces_vanish();
  roots_are_found_where_signs_change();
  celspan_context_destroy(context);
  return check_done();
}
