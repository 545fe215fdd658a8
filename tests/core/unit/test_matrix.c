#include "model/geometry/matrix.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

static celspan_point apply(celspan_matrix matrix, double x, double y) {
  cs_hpoint p = cs_matrix_apply(&matrix, (cs_hpoint){x, y, 1});
  return (celspan_point){p.x / p.w, p.y / p.w};
}

static void check_goes(celspan_matrix matrix, double x, double y, double to_x, double to_y) {
  celspan_point p = apply(matrix, x, y);
  double tolerance = 1e-9 * (1 + fabs(to_x) + fabs(to_y));
  CHECK_NEAR(p.x, to_x, tolerance);
  CHECK_NEAR(p.y, to_y, tolerance);
}

static void makers_move_points(void) {
  check_goes(celspan_matrix_identity(), 3, 4, 3, 4);
  check_goes(celspan_matrix_translation(10, -2), 3, 4, 13, 2);
  check_goes(celspan_matrix_scaling(2, -3), 3, 4, 6, -12);
  double quarter = 3.14159265358979323846 / 2;
  check_goes(celspan_matrix_rotation(quarter, (celspan_point){0, 0}), 1, 0, 0, 1); /* clockwise */
  check_goes(celspan_matrix_rotation(quarter, (celspan_point){5, 5}), 6, 5, 5, 6);
  check_goes(celspan_matrix_rotation(1.234, (celspan_point){5, 5}), 5, 5, 5, 5);
  check_goes(celspan_matrix_skewing(quarter / 2, 0), 1, 2, 3, 2);
  check_goes(celspan_matrix_skewing(0, quarter / 2), 1, 2, 1, 3);
}

static void makers_about_a_centre_keep_it(void) {
  double eighth = 3.14159265358979323846 / 4;
  celspan_point centre = {5, 7};
  check_goes(celspan_matrix_scaling_about(2, -3, centre), 5, 7, 5, 7);
  check_goes(celspan_matrix_scaling_about(2, -3, centre), 6, 8, 7, 4);
  check_goes(celspan_matrix_skewing_about(eighth, 0, centre), 5, 7, 5, 7);
  check_goes(celspan_matrix_skewing_about(eighth, 0, centre), 5, 9, 7, 9);
  check_goes(celspan_matrix_skewing_about(0, -eighth, centre), 8, 7, 8, 4);
  /* About the origin they are the plain ones, to the bit. */
  celspan_matrix plain = celspan_matrix_skewing(-0.5, 0.5);
  celspan_matrix about = celspan_matrix_skewing_about(-0.5, 0.5, (celspan_point){0, 0});
  CHECK(memcmp(&plain, &about, sizeof plain) == 0);
  plain = celspan_matrix_scaling(-2, 3);
  about = celspan_matrix_scaling_about(-2, 3, (celspan_point){0, 0});
  CHECK(memcmp(&plain, &about, sizeof plain) == 0);
}

static void then_applies_the_first_first(void) {
  celspan_matrix both =
      celspan_matrix_then(celspan_matrix_translation(1, 0), celspan_matrix_scaling(10, 10));
  check_goes(both, 1, 1, 20, 10);
}

static void inverse_undoes(void) {
  for (int seed = 1; seed <= 200; seed++) {
    test_random random = {(uint64_t)seed};
    celspan_matrix matrix, inverse;
    for (int i = 0; i < 9; i++)
      matrix.m[i] = random_between(&random, -1, 1) * (i < 6 ? 10 : 0.1);
    matrix.m[8] += 1;
    if (!CHECK(celspan_matrix_inverse(matrix, &inverse)))
      continue;
    celspan_matrix none = celspan_matrix_then(matrix, inverse);
    for (int i = 0; i < 9; i++)
      CHECK_NEAR(none.m[i], i % 4 == 0, 1e-9);
  }
}

static void singular_matrices_have_no_inverse(void) {
  celspan_matrix untouched = celspan_matrix_scaling(7, 7), out = untouched;
  CHECK(!celspan_matrix_inverse(celspan_matrix_scaling(0, 1), &out));
  CHECK(!celspan_matrix_inverse((celspan_matrix){{1, 2, 3, 2, 4, 6, 0, 0, 1}}, &out));
  CHECK(!celspan_matrix_inverse((celspan_matrix){{0.1, 0.2, 0, 0.3, 0.6, 0, 0, 0, 1}}, &out));
  CHECK(!celspan_matrix_inverse((celspan_matrix){{0}}, &out));
  CHECK(memcmp(&out, &untouched, sizeof out) == 0);
  /* Small or lopsided is not singular. */
  CHECK(celspan_matrix_inverse(celspan_matrix_scaling(1e-9, 1e9), &out));
}

static void quad_takes_corners_to_corners(void) {
  const celspan_point from[4] = {{0, 0}, {100, 0}, {100, 50}, {0, 50}};
  for (int seed = 1; seed <= 200; seed++) {
    test_random random = {(uint64_t)seed};
    celspan_point to[4];
    const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; i++) {
      celspan_point away = random_point(&random, 60, 150, 60, 150);
      to[i] = (celspan_point){300 + signs[i][0] * away.x, 200 + signs[i][1] * away.y};
    }
    celspan_matrix quad;
    if (!CHECK(celspan_matrix_quad(from, to, &quad)))
      continue;
    for (int i = 0; i < 4; i++) {
      check_goes(quad, from[i].x, from[i].y, to[i].x, to[i].y);
      CHECK(cs_matrix_apply(&quad, (cs_hpoint){from[i].x, from[i].y, 1}).w > 0);
    }
  }
}

static void quad_keeps_affine_maps_affine(void) {
  const celspan_point from[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const celspan_point to[4] = {{10, 20}, {12, 20}, {12, 26}, {10, 26}};
  celspan_matrix quad;
  CHECK(celspan_matrix_quad(from, to, &quad));
  CHECK(cs_matrix_is_upright(&quad));
  check_goes(quad, 0.5, 0.5, 11, 23);
}

static void quads_with_three_corners_on_a_line_have_none(void) {
  const celspan_point good[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const celspan_point flat[4] = {{0, 0}, {1, 1}, {2, 2}, {0, 5}};
  const celspan_point point[4] = {{3, 3}, {3, 3}, {3, 3}, {3, 3}};
  celspan_matrix out;
  CHECK(!celspan_matrix_quad(good, flat, &out));
  CHECK(!celspan_matrix_quad(flat, good, &out));
  CHECK(!celspan_matrix_quad(good, point, &out));
}

static void kinds_are_distinguished(void) {
  celspan_matrix turned = celspan_matrix_rotation(0.3, (celspan_point){0, 0});
  celspan_matrix steep = celspan_matrix_identity(), large = steep;
  steep.m[6] = 0.01;
  large.m[2] = 1e13;
  CHECK(cs_matrix_is_affine(&turned) && !cs_matrix_is_upright(&turned));
  CHECK(!cs_matrix_is_affine(&steep) && !cs_matrix_is_upright(&steep));
  CHECK(cs_matrix_is_upright(&large) && !cs_matrix_is_sane(&large));
  CHECK(cs_matrix_is_sane(&steep));
}

int main(void) {
  makers_move_points();
  makers_about_a_centre_keep_it();
  then_applies_the_first_first();
  inverse_undoes();
  singular_matrices_have_no_inverse();
  quad_takes_corners_to_corners();
  quad_keeps_affine_maps_affine();
  quads_with_three_corners_on_a_line_have_none();
  kinds_are_distinguished();
  return check_done();
}
