/* The oracle against values worked out by hand. The film is 100 x 50 units. One list of independent
 * cases. */
#include "tests/support/memory.h"
#include "tests/support/probe.h"
#include "tests/support/scene.h"

#define TINY 1e-6

static const celspan_paint red = {{1, 0, 0}, {1, 1, 1}, 1};
static const celspan_paint green = {{0, 1, 0}, {1, 1, 1}, 1};
static const celspan_paint blue = {{0, 0, 1}, {1, 1, 1}, 1};

static void probe(studio *s, celspan_rostrum *rostrum, double x, double y, double rgba[4]) {
  celspan_exposure exposure = {rostrum, 1};
  for (int c = 0; c < 4; c++)
    rgba[c] = -1;
  studio_check(s, probe_film(s->context, &exposure, 1, 100, 50, (celspan_point){x, y}, rgba));
}

#define EXPECT(s, rostrum, x, y, r, g, b, a)                                                       \
  do {                                                                                             \
    double got_[4];                                                                                \
    const double expected_[4] = {r, g, b, a};                                                      \
    probe(s, rostrum, x, y, got_);                                                                 \
    for (int c_ = 0; c_ < 4; c_++)                                                                 \
      CHECK_NEAR(got_[c_], expected_[c_], TINY);                                                   \
  } while (0)

/* ---------------------------------------------------------------- shapes */

static void test_rectangle_is_half_open(studio *s) {
  celspan_rostrum *r = studio_show(s, studio_rect(s, 10, 10, 20, 5, studio_paint(s, red)));
  EXPECT(s, r, 10, 10, 1, 0, 0, 1);
  EXPECT(s, r, 29.999, 14.999, 1, 0, 0, 1);
  EXPECT(s, r, 30, 12, 0, 0, 0, 0);
  EXPECT(s, r, 12, 15, 0, 0, 0, 0);
  EXPECT(s, r, 9.999, 12, 0, 0, 0, 0);
}

static void test_default_texture_is_black(studio *s) {
  EXPECT(s, studio_show(s, studio_rect(s, 0, 0, 9, 9, NULL)), 5, 5, 0, 0, 0, 1);
}

/* A circle of radius 10 around 50, 25: probed on both sides of its edge all the way round. */
static void test_circle(studio *s) {
  celspan_object *circle = studio_circle(s, 50, 25, 10, NULL);
  for (int i = 0; i < 360; i++) {
    double x = cos(i * 3.141592653589793 / 180), y = sin(i * 3.141592653589793 / 180);
    CHECK(celspan_object_contains(circle, (celspan_point){50 + 9.999999 * x, 25 + 9.999999 * y}));
    CHECK(
        !celspan_object_contains(circle, (celspan_point){50 + 10.000001 * x, 25 + 10.000001 * y}));
  }
}

static void test_rules(studio *s) {
  /* Two squares, one inside the other, run the same way round. */
  const celspan_point points[] = {{0, 0},   {30, 0},  {30, 30}, {0, 30},  {0, 0},
                                  {10, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 10}};
  celspan_object *nonzero = studio_polygon(s, points, 10, CELSPAN_RULE_NONZERO, NULL);
  celspan_object *evenodd = studio_polygon(s, points, 10, CELSPAN_RULE_EVENODD, NULL);
  CHECK(celspan_object_contains(nonzero, (celspan_point){15, 14}));
  CHECK(!celspan_object_contains(evenodd, (celspan_point){15, 14}));
  CHECK(celspan_object_contains(evenodd, (celspan_point){25, 5}));
}

/* On slanted edges too the left ones are in and the right ones out. */
static void test_slanted_edges_are_half_open(studio *s) {
  const celspan_point points[] = {{10, 0}, {20, 10}, {10, 20}, {0, 10}};
  celspan_object *diamond = studio_polygon(s, points, 4, CELSPAN_RULE_NONZERO, NULL);
  for (int i = 1; i < 20; i++) {
    double half = i < 10 ? i : 20 - i;
    CHECK(celspan_object_contains(diamond, (celspan_point){10 - half, i}));
    CHECK(!celspan_object_contains(diamond, (celspan_point){10 + half, i}));
  }
}

/* y = x^3 between 0 and 30, the curve of a cubic piece, closed below it. */
static void test_curve(studio *s) {
  celspan_object *curve = studio_path(s, "M0 0 C10 0 20 0 30 30 L0 30 Z", NULL);
  for (int i = 1; i < 100; i++) {
    double t = i / 100.0, x = 30 * t, y = 30 * t * t * t;
    CHECK(celspan_object_contains(curve, (celspan_point){x, y + 1e-9}));
    CHECK(!celspan_object_contains(curve, (celspan_point){x, y - 1e-9}));
  }
}

static void test_empty_things_draw_nothing(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 50, 50, studio_paint(s, red));
  celspan_object *const nothing[] = {
      studio_rect(s, 0, 0, 0, 50, NULL),
      studio_circle(s, 5, 5, 0, NULL),
      studio_polygon(s, NULL, 0, CELSPAN_RULE_NONZERO, NULL),
      studio_boolean(s, CELSPAN_OPERATOR_UNION, NULL, 0),
      studio_boolean(s, CELSPAN_OPERATOR_INTERSECTION, NULL, 0),
      studio_boolean(s, CELSPAN_OPERATOR_DIFFERENCE, NULL, 0),
      studio_boolean(s, CELSPAN_OPERATOR_XOR, NULL, 0),
      studio_transform(s, rect, celspan_matrix_scaling(0, 1)),
      studio_transform(s, rect, (celspan_matrix){{0}}),
  };
  for (size_t i = 0; i < sizeof nothing / sizeof *nothing; i++) {
    celspan_box box;
    CHECK(!celspan_object_bounds(nothing[i], &box));
    CHECK(!celspan_object_contains(nothing[i], (celspan_point){5, 5}));
    EXPECT(s, studio_show(s, nothing[i]), 5, 5, 0, 0, 0, 0);
    EXPECT(s, studio_show(s, nothing[i]), 0, 0, 0, 0, 0, 0);
  }
}

/* ---------------------------------------------------------------- transforms */

static void test_order_of_transforms(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 10, 10, studio_paint(s, red));
  celspan_object *moved = studio_transform(s, rect, celspan_matrix_translation(10, 0));
  celspan_rostrum *r = studio_show(s, studio_transform(s, moved, celspan_matrix_scaling(2, 2)));
  EXPECT(s, r, 21, 1, 1, 0, 0, 1);
  EXPECT(s, r, 19, 1, 0, 0, 0, 0);
  EXPECT(s, r, 39, 19, 1, 0, 0, 1);
}

static void test_matrices_nest(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 10, 10, studio_paint(s, red));
  celspan_object *turned =
      studio_transform(s, rect, celspan_matrix_rotation(1.5707963267948966, (celspan_point){0, 0}));
  celspan_object *both = studio_boolean(s, CELSPAN_OPERATOR_UNION, &turned, 1);
  celspan_rostrum *r = studio_show(s, studio_transform(s, both, celspan_matrix_translation(20, 0)));
  EXPECT(s, r, 15, 5, 1, 0, 0, 1); /* a quarter clockwise takes x to y and y to -x */
  EXPECT(s, r, 25, 5, 0, 0, 0, 0);
}

/* x' = x / (1 + y/100): points with y <= -100 are behind the horizon. */
static void test_perspective(studio *s) {
  celspan_matrix matrix = {{1, 0, 0, 0, 1, 0, 0, 0.01, 1}};
  celspan_object *rect = studio_rect(s, -1000, -1000, 2000, 2000, studio_paint(s, red));
  celspan_object *tilted = studio_transform(s, rect, matrix);
  celspan_rostrum *r = studio_show(s, tilted);
  /* Film y = Y/(1 + Y/100) stays below 100 for Y > -100; points above 100 are behind the
   * horizon. */
  EXPECT(s, r, 50, 40, 1, 0, 0, 1);
  CHECK(celspan_object_contains(tilted, (celspan_point){0, 90}));
  CHECK(!celspan_object_contains(tilted, (celspan_point){0, 91}));    /* Y = 1000 lands on 90.9 */
  CHECK(!celspan_object_contains(tilted, (celspan_point){0, 111.2})); /* Y = -1000: behind */
  CHECK(!celspan_object_contains(tilted, (celspan_point){0, 150}));   /* Y = -300 */
  CHECK(celspan_object_contains(tilted, (celspan_point){0, -400}));
}

/* A matrix and its negative are the same map, as long as there is no horizon to distinguish
 * them. */
static void test_negative_affine(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 10, 10, NULL);
  celspan_matrix matrix = {{-1, 0, 0, 0, -1, 0, 0, 0, -1}};
  CHECK(celspan_object_contains(studio_transform(s, rect, matrix), (celspan_point){5, 5}));
}

/* ---------------------------------------------------------------- booleans */

/* Red on columns 0..20, green on 10..30: probed at 5, 15, 25 and 35. */
static void test_boolean_pair(studio *s, celspan_operator op, const char *expected) {
  celspan_object *a = studio_rect(s, 0, 0, 20, 50, studio_paint(s, red));
  celspan_object *b = studio_rect(s, 10, 0, 20, 50, studio_paint(s, green));
  celspan_object *both = studio_pair(s, op, a, b);
  celspan_rostrum *r = studio_show(s, both);
  for (int i = 0; i < 4; i++) {
    double x = 5 + 10 * i;
    EXPECT(s, r, x, 25, expected[i] == 'r', expected[i] == 'g', 0, expected[i] != '-');
    CHECK(celspan_object_contains(both, (celspan_point){x, 25}) == (expected[i] != '-'));
  }
}

static void test_booleans(studio *s) {
  test_boolean_pair(s, CELSPAN_OPERATOR_UNION, "rgg-");
  test_boolean_pair(s, CELSPAN_OPERATOR_INTERSECTION, "-g--");
  test_boolean_pair(s, CELSPAN_OPERATOR_DIFFERENCE, "r---");
  test_boolean_pair(s, CELSPAN_OPERATOR_XOR, "r-g-");
  test_boolean_pair(s, CELSPAN_OPERATOR_CLIP, "-r--");
}

static void test_many_operands(studio *s) {
  celspan_object *const all[] = {studio_rect(s, 0, 0, 40, 50, studio_paint(s, red)),
                                 studio_rect(s, 10, 0, 40, 50, studio_paint(s, green)),
                                 studio_rect(s, 20, 0, 40, 50, studio_paint(s, blue))};
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_XOR, all, 3)), 25, 9, 0, 0, 1, 1);
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_XOR, all, 3)), 15, 9, 0, 0, 0, 0);
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_DIFFERENCE, all, 3)), 5, 9, 1, 0, 0,
         1);
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_DIFFERENCE, all, 3)), 25, 9, 0, 0, 0,
         0);
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_INTERSECTION, all, 3)), 25, 9, 0, 0,
         1, 1);
  EXPECT(s, studio_show(s, studio_boolean(s, CELSPAN_OPERATOR_INTERSECTION, all, 3)), 15, 9, 0, 0,
         0, 0);
}

/* An operand that is faded out still has its shape: it cuts, and lets the other one show. */
static void test_fade_inside_boolean(studio *s) {
  celspan_object *a = studio_rect(s, 0, 0, 20, 50, studio_paint(s, red));
  celspan_object *b = studio_fade(s, studio_rect(s, 10, 0, 20, 50, studio_paint(s, green)), 0);
  EXPECT(s, studio_show(s, studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, a, b)), 15, 9, 0, 0, 0, 0);
  EXPECT(s, studio_show(s, studio_pair(s, CELSPAN_OPERATOR_UNION, a, b)), 15, 9, 1, 0, 0, 1);
  b = studio_fade(s, studio_rect(s, 10, 0, 20, 50, studio_paint(s, green)), 0.25);
  EXPECT(s, studio_show(s, studio_pair(s, CELSPAN_OPERATOR_UNION, a, b)), 15, 9, 0.75, 0.25, 0, 1);
  celspan_object *both = studio_pair(s, CELSPAN_OPERATOR_UNION, a, b);
  EXPECT(s, studio_show(s, studio_fade(s, both, 0.5)), 15, 9, 0.375, 0.125, 0, 0.5);
}

static void test_fades_multiply(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 20, 50, studio_paint(s, red));
  EXPECT(s, studio_show(s, studio_fade(s, studio_fade(s, rect, 0.5), 0.5)), 5, 5, 0.25, 0, 0, 0.25);
}

/* ---------------------------------------------------------------- lights */

static void test_later_is_nearer(studio *s) {
  celspan_object *const objects[] = {studio_rect(s, 0, 0, 50, 50, studio_paint(s, red)),
                                     studio_rect(s, 0, 0, 50, 50, studio_paint(s, green))};
  celspan_cel *const cels[] = {studio_cel(s, CELSPAN_CEL_DESC, objects, 2),
                               studio_cel(s, CELSPAN_CEL_DESC, objects, 1)};
  EXPECT(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 1), 5, 5, 0, 1, 0, 1);
  EXPECT(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, cels, 2), 5, 5, 1, 0, 0, 1);
}

/* L = S F + T (B + L), each cel under its own lights; the rostrum's brightness on all of them. */
static void test_lit_stack(studio *s) {
  celspan_paint half = celspan_paint_rgb(1, 0.5f, 0, 0.5f);
  celspan_object *rear = studio_rect(s, 0, 0, 50, 50, studio_paint(s, half));
  celspan_object *gel =
      studio_rect(s, 0, 0, 50, 50, studio_paint(s, celspan_paint_gel(1, 0.5f, 0)));
  celspan_cel_desc rear_desc = CELSPAN_CEL_DESC, gel_desc = CELSPAN_CEL_DESC;
  rear_desc.has_front = true;
  rear_desc.front = (celspan_light){2, 1, 1, 1};
  gel_desc.back = (celspan_light){0.25f, 0.25f, 0.25f, 0.5f};
  celspan_cel *const cels[] = {studio_cel(s, rear_desc, &rear, 1),
                               studio_cel(s, gel_desc, &gel, 1)};
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.back = (celspan_light){0.5f, 0.5f, 0.5f, 0};
  /* rear: 0.5 (1, 0.5, 0) (2, 1, 1) + 0.5 * 0.5 = (1.25, 0.5, 0.25), matte 0.5
   * gel:  (1, 0.5, 0) ((1.25, 0.5, 0.25) + 0.25), matte 0.75, then 1 - T/4 = (0.75, 0.875, 1) */
  EXPECT(s, studio_rostrum(s, desc, cels, 2), 5, 5, 1.5, 0.375, 0, 0.875);
  desc.brightness = 2;
  EXPECT(s, studio_rostrum(s, desc, cels, 2), 5, 5, 3, 0.75, 0, 0.875);
  desc.brightness = 1;
  desc.has_front = true;
  desc.front = (celspan_light){0, 0, 0, 1}; /* the rear cel names its own, the gel scatters none */
  EXPECT(s, studio_rostrum(s, desc, cels, 2), 5, 5, 1.5, 0.375, 0, 0.875);
}

static void test_back_light_is_everywhere(studio *s) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.back = (celspan_light){0.5f, 1, 2, 0.25f};
  celspan_cel *cel = studio_cel(s, desc, NULL, 0);
  EXPECT(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1), 5, 5, 0.5, 1, 2, 0.25);
}

static void test_cel_opacity(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 50, 50, studio_paint(s, red));
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.opacity = 0.25;
  desc.back = (celspan_light){0, 0, 1, 0};
  celspan_cel *cel = studio_cel(s, desc, &rect, 1);
  EXPECT(s, studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1), 5, 5, 0.25, 0, 0.75, 0.25);
}

static void test_exposures(studio *s) {
  celspan_exposure exposures[] = {
      {studio_show(s, studio_rect(s, 0, 0, 50, 50, studio_paint(s, red))), 0.75},
      {studio_show(s, studio_rect(s, 25, 0, 50, 50, studio_paint(s, green))), 0.5}};
  double rgba[4];
  studio_check(s, probe_film(s->context, exposures, 2, 100, 50, (celspan_point){30, 5}, rgba));
  CHECK_NEAR(rgba[0], 0.75, TINY);
  CHECK_NEAR(rgba[1], 0.5, TINY);
  CHECK_NEAR(rgba[3], 1, 0);
  studio_check(s, probe_film(s->context, exposures, 2, 100, 50, (celspan_point){60, 5}, rgba));
  CHECK_NEAR(rgba[3], 0.5, TINY);
}

/* ---------------------------------------------------------------- camera */

static void test_viewport_and_camera(studio *s) {
  celspan_object *rect = studio_rect(s, 20, 10, 10, 5, studio_paint(s, red));
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.has_viewport = true;
  cel_desc.viewport = (celspan_box){20, 10, 50, 25};
  celspan_cel *cel = studio_cel(s, cel_desc, &rect, 1);
  celspan_rostrum *r = studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  EXPECT(s, r, 0, 0, 1, 0, 0, 1); /* the viewport's corner is the film's, twice as large */
  EXPECT(s, r, 19.9, 9.9, 1, 0, 0, 1);
  EXPECT(s, r, 20.1, 5, 0, 0, 0, 0);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.has_camera_centre = desc.has_camera_width = true;
  desc.camera_centre = (celspan_point){0, 0};
  desc.camera_width = 200;
  r = studio_rostrum(s, desc, &cel, 1); /* film's corner to its centre, half as large */
  EXPECT(s, r, 50, 25, 1, 0, 0, 1);
  EXPECT(s, r, 59.9, 29.9, 1, 0, 0, 1);
  EXPECT(s, r, 60.1, 26, 0, 0, 0, 0);
  EXPECT(s, r, 49.9, 26, 0, 0, 0, 0);
}

/* The camera turns clockwise, so what is right of the centre rises. */
static void test_camera_rotation(studio *s) {
  celspan_object *rect = studio_rect(s, 60, 24, 10, 2, studio_paint(s, red));
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &rect, 1);
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.camera_radians = 1.5707963267948966;
  celspan_rostrum *r = studio_rostrum(s, desc, &cel, 1);
  EXPECT(s, r, 50, 10, 1, 0, 0, 1);
  EXPECT(s, r, 50, 40, 0, 0, 0, 0);
}

/* ---------------------------------------------------------------- textures */

static void test_triangle_gradient(studio *s) {
  const celspan_point points[3] = {{0, 0}, {10, 0}, {0, 10}};
  const celspan_paint paints[3] = {celspan_paint_rgb(1, 0, 0, 1), celspan_paint_rgb(0, 1, 0, 0.5f),
                                   celspan_paint_clear()};
  celspan_object *rect = studio_rect(s, 0, 0, 100, 50, studio_gradient(s, points, paints));
  celspan_rostrum *r = studio_show(s, rect);
  EXPECT(s, r, 0, 0, 1, 0, 0, 1);
  EXPECT(s, r, 5, 0, 0.5, 0.25, 0, 0.75);
  EXPECT(s, r, 2.5, 5, 0.25, 0.125, 0, 0.375);
  /* Beyond the corners beta continues to fall to 0 and is clamped there; S is clamped below it. */
  EXPECT(s, r, 15, 0, 0, 0.25, 0, 0.25);
  EXPECT(s, r, 40, 0, 0, 0, 0, 0);
}

static void test_linear_gradient(studio *s) {
  const celspan_stop stops[] = {{0.25, {{1, 0, 0}, {1, 1, 1}, 1}},
                                {0.5, {{0, 1, 0}, {1, 1, 1}, 1}},
                                {0.5, {{0, 0, 1}, {1, 1, 1}, 1}},
                                {1, {{0, 0, 1}, {1, 1, 1}, 0}}};
  celspan_texture *texture =
      studio_linear(s, (celspan_point){10, 0}, (celspan_point){50, 0}, stops, 4);
  celspan_rostrum *r = studio_show(s, studio_rect(s, 0, 0, 100, 50, texture));
  EXPECT(s, r, 1, 9, 1, 0, 0, 1);
  EXPECT(s, r, 20, 30, 1, 0, 0, 1);
  EXPECT(s, r, 25, 3, 0.5, 0.5, 0, 1);
  EXPECT(s, r, 30, 3, 0, 0, 1, 1); /* at a hard edge the later stop begins */
  EXPECT(s, r, 40, 3, 0, 0, 0.5, 0.5);
  EXPECT(s, r, 90, 3, 0, 0, 0, 0);
}

static void test_radial_gradient(studio *s) {
  const celspan_stop stops[] = {{0, {{1, 0, 0}, {1, 1, 1}, 1}}, {1, {{0, 1, 0}, {1, 1, 1}, 1}}};
  celspan_texture *texture = studio_radial(s, (celspan_point){50, 25}, 10, stops, 2);
  celspan_rostrum *r = studio_show(s, studio_rect(s, 0, 0, 100, 50, texture));
  EXPECT(s, r, 50, 25, 1, 0, 0, 1);
  EXPECT(s, r, 53, 29, 0.5, 0.5, 0, 1);
  EXPECT(s, r, 90, 29, 0, 1, 0, 1);
}

/* A quarter of the way round, clockwise from up; the colour jumps where it begins. */
static void test_conic_gradient(studio *s) {
  const celspan_stop stops[] = {{0, {{1, 0, 0}, {1, 1, 1}, 1}}, {1, {{0, 1, 0}, {1, 1, 1}, 1}}};
  celspan_texture *texture = studio_conic(s, (celspan_point){50, 25}, 0, stops, 2);
  celspan_rostrum *r = studio_show(s, studio_rect(s, 0, 0, 100, 50, texture));
  EXPECT(s, r, 60, 25, 0.75, 0.25, 0, 1);
  EXPECT(s, r, 50, 40, 0.5, 0.5, 0, 1);
  EXPECT(s, r, 40, 35, 0.375, 0.625, 0, 1);
  EXPECT(s, r, 40, 15, 0.125, 0.875, 0, 1);
}

/* Gradients of no length: everything lies past the last stop, the last corner. */
static void test_degenerate_gradients(studio *s) {
  const celspan_stop stops[] = {{0, {{1, 0, 0}, {1, 1, 1}, 1}}, {1, {{0, 1, 0}, {1, 1, 1}, 1}}};
  const celspan_point line[3] = {{0, 0}, {10, 10}, {30, 30}};
  const celspan_paint paints[3] = {red, blue, green};
  celspan_texture *const textures[] = {
      studio_linear(s, (celspan_point){9, 9}, (celspan_point){9, 9}, stops, 2),
      studio_radial(s, (celspan_point){9, 9}, 0, stops, 2), studio_gradient(s, line, paints)};
  for (size_t i = 0; i < 3; i++)
    EXPECT(s, studio_show(s, studio_rect(s, 0, 0, 100, 50, textures[i])), 9, 9, 0, 1, 0, 1);
}

static void test_texture_moves_with_its_object(studio *s) {
  const celspan_stop stops[] = {{0, {{0, 0, 0}, {1, 1, 1}, 1}}, {1, {{1, 1, 1}, {1, 1, 1}, 1}}};
  celspan_texture *texture =
      studio_linear(s, (celspan_point){0, 0}, (celspan_point){10, 0}, stops, 2);
  celspan_object *rect = studio_rect(s, 0, 0, 10, 10, texture);
  celspan_object *large = studio_transform(s, rect, celspan_matrix_scaling(4, 4));
  EXPECT(s, studio_show(s, studio_transform(s, large, celspan_matrix_translation(20, 0))), 30, 5,
         0.25, 0.25, 0.25, 1);
}

/* ---------------------------------------------------------------- procedures */

/* Red on the first fifth of its bounds, from red to green on 4..8; y as requested. */
static celspan_status stripes(void *user, celspan_context *context, double y,
                              const celspan_scanline_row *row, celspan_scanline_output *output) {
  const celspan_paint ramp[] = {red, green};
  (void)context;
  *(double *)user = y;
  celspan_status status = celspan_scanline_emit(output, row->x0 - 1, row->x0 + 2, &red, 1);
  return status != CELSPAN_OK ? status : celspan_scanline_emit(output, 4, 12, ramp, 2);
}

static void test_scanline(studio *s) {
  double y = -1;
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 10, 5}, .spans = stripes, .user = &y};
  celspan_object *object = studio_scanline(s, &desc);
  celspan_object *placed = studio_transform(s, object, celspan_matrix_scaling(2, 2));
  celspan_rostrum *r = studio_show(s, placed);
  EXPECT(s, r, 1, 3, 1, 0, 0, 1);
  CHECK(y == 1.5);
  EXPECT(s, r, 5, 3, 0, 0, 0, 0);
  EXPECT(s, r, 12, 3, 0.75, 0.25, 0, 1);
  EXPECT(s, r, 19.9, 3, 0.25625, 0.74375, 0, 1);
  EXPECT(s, r, 21, 3, 0, 0, 0, 0); /* the span extends to 12, the bounds end at 10 */
  celspan_object *rect = studio_rect(s, 0, 0, 40, 40, studio_paint(s, blue));
  EXPECT(s, studio_show(s, studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, rect, placed)), 1, 3, 0, 0,
         0, 0);
  EXPECT(s, studio_show(s, studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, rect, placed)), 5, 3, 0, 0,
         1, 1);
}

static const double (*bad_spans)[2];

static celspan_status emit_bad(void *user, celspan_context *context, double y,
                               const celspan_scanline_row *row, celspan_scanline_output *output) {
  (void)user, (void)context, (void)y, (void)row;
  for (int i = 0; i < 2; i++)
    if (celspan_scanline_emit(output, bad_spans[i][0], bad_spans[i][1], &red, 1) != CELSPAN_OK)
      break; /* without reporting it: the failure is remembered */
  return CELSPAN_OK;
}

static celspan_status fail_silently(void *user, celspan_context *context, double y,
                                    const celspan_scanline_row *row,
                                    celspan_scanline_output *output) {
  (void)user, (void)context, (void)y, (void)row, (void)output;
  return CELSPAN_CALLBACK;
}

static void expect_callback_error(studio *s, celspan_scanline_spans spans, const char *message) {
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 10, 5}, .spans = spans};
  celspan_exposure exposure = {studio_show(s, studio_scanline(s, &desc)), 1};
  double rgba[4] = {7, 7, 7, 7};
  CHECK(probe_film(s->context, &exposure, 1, 100, 50, (celspan_point){1, 1.5}, rgba) ==
        CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(s->context), message);
  CHECK(rgba[0] == 7);
}

static void test_scanline_errors(studio *s) {
  static const double overlap[2][2] = {{0, 4}, {3, 5}}, backwards[2][2] = {{0, 1}, {4, 3}},
                      endless[2][2] = {{0, 1}, {2, INFINITY}};
  bad_spans = overlap;
  expect_callback_error(s, emit_bad,
                        "scanline: span 2 at y = 1.5 begins at 3, before the one before it ends at "
                        "4; spans must ascend and not overlap");
  bad_spans = backwards;
  expect_callback_error(s, emit_bad,
                        "scanline: span 2 at y = 1.5 ends at 3, before it begins at 4");
  bad_spans = endless;
  expect_callback_error(s, emit_bad,
                        "scanline: the end of span 2 at y = 1.5 must be a finite number, got inf");
  expect_callback_error(s, fail_silently, "scanline: its spans function failed at y = 1.5");
}

/* ---------------------------------------------------------------- pictures */

/* An uncompressed Targa of 4 x 2 pixels, read as linear: red 0.2 x, green y, opaque. */
static bool write_picture(const char *path) {
  unsigned char bytes[18 + 24] = {[2] = 2, [12] = 4, [14] = 2, [16] = 24, [17] = 0x20};
  for (int i = 0; i < 8; i++) {
    bytes[18 + 3 * i + 1] = (unsigned char)(255 * (i / 4));
    bytes[18 + 3 * i + 2] = (unsigned char)(51 * (i % 4));
  }
  FILE *file = fopen(path, "wb");
  return file && fwrite(bytes, sizeof bytes, 1, file) == 1 && fclose(file) == 0;
}

static celspan_rostrum *show_picture(studio *s, celspan_picture_desc desc) {
  celspan_texture *texture = NULL;
  studio_check(s, celspan_texture_create_picture(s->context, &desc, &texture));
  celspan_object *rect = studio_rect(s, 10, 10, 40, 20, texture);
  celspan_texture_unref(texture);
  return studio_show(s, rect);
}

static void check_picture(studio *s, celspan_picture_desc desc) {
  celspan_rostrum *r = show_picture(s, desc); /* ten units a pixel, on the rectangle's own box */
  EXPECT(s, r, 15, 15, 0, 0, 0, 1);
  EXPECT(s, r, 35, 25, 0.4, 1, 0, 1);
  EXPECT(s, r, 30, 20, 0.3, 0.5, 0, 1);
  EXPECT(s, r, 11, 11, 0, 0, 0, 1); /* its edges are not blurred */
  EXPECT(s, r, 49.9, 29.9, 0.6, 1, 0, 1);
  desc.use = CELSPAN_PICTURE_GEL;
  EXPECT(s, show_picture(s, desc), 35, 25, 0, 0, 0, (0.6 + 0 + 1) / 3);
  desc.use = CELSPAN_PICTURE_PAINT;
  desc.has_box = true;
  desc.box = (celspan_box){20, 15, 4, 2};
  EXPECT(s, show_picture(s, desc), 22.5, 16.5, 0.4, 1, 0, 1);
  EXPECT(s, show_picture(s, desc), 24, 16, 0, 0, 0, 0); /* the box is half-open */
  EXPECT(s, show_picture(s, desc), 19.9, 16, 0, 0, 0, 0);
  desc.wrap = CELSPAN_WRAP_CLAMP;
  EXPECT(s, show_picture(s, desc), 40, 28, 0.6, 1, 0, 1);
  desc.wrap = CELSPAN_WRAP_REPEAT;
  EXPECT(s, show_picture(s, desc), 26.5, 18.5, 0.4, 1, 0, 1);
  EXPECT(s, show_picture(s, desc), 16, 15.5, 0.3, 0, 0,
         1); /* half of the last, half of the first */
}

static void test_pictures(studio *s) {
  celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = "4x2.probe.tga", .colour = "linear"};
  celspan_picture_info info = CELSPAN_PICTURE_INFO;
  CHECK(write_picture(desc.file));
  if (celspan_picture_inspect(s->context, &desc, &info) == CELSPAN_OK)
    check_picture(s, desc);
  else
    check_skip("the picture module");
  remove(desc.file);
}

/* A box of no size draws nothing, and its picture file is not even opened. */
static void test_picture_without_size(studio *s) {
  celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = "there/is/no/such.png", .has_box = true};
  EXPECT(s, show_picture(s, desc), 15, 15, 0, 0, 0, 0);
}

static void test_hidden_picture_is_not_read(studio *s) {
  celspan_picture_desc desc = {.struct_size = sizeof desc, .file = "there/is/no/such.png"};
  celspan_texture *texture = NULL;
  studio_check(s, celspan_texture_create_picture(s->context, &desc, &texture));
  celspan_object *const objects[] = {studio_rect(s, 0, 0, 50, 50, texture),
                                     studio_rect(s, 0, 0, 20, 50, studio_paint(s, red))};
  celspan_texture_unref(texture);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, objects, 2);
  celspan_rostrum *r = studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &cel, 1);
  EXPECT(s, r, 5, 5, 1, 0, 0, 1);
  double rgba[4];
  celspan_exposure exposure = {r, 1};
  CHECK(probe_film(s->context, &exposure, 1, 100, 50, (celspan_point){30, 5}, rgba) ==
        CELSPAN_INPUT);
  CHECK(celspan_rostrum_check(s->context, r) == CELSPAN_INPUT);
}

int main(void) {
  void (*const tests[])(studio *) = {
      test_rectangle_is_half_open,
      test_default_texture_is_black,
      test_circle,
      test_rules,
      test_slanted_edges_are_half_open,
      test_curve,
      test_empty_things_draw_nothing,
      test_order_of_transforms,
      test_matrices_nest,
      test_perspective,
      test_negative_affine,
      test_booleans,
      test_many_operands,
      test_fade_inside_boolean,
      test_fades_multiply,
      test_later_is_nearer,
      test_lit_stack,
      test_back_light_is_everywhere,
      test_cel_opacity,
      test_exposures,
      test_viewport_and_camera,
      test_camera_rotation,
      test_triangle_gradient,
      test_linear_gradient,
      test_radial_gradient,
      test_conic_gradient,
      test_degenerate_gradients,
      test_texture_moves_with_its_object,
      test_scanline,
      test_scanline_errors,
      test_pictures,
      test_picture_without_size,
      test_hidden_picture_is_not_read,
  };
  for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
    memory_watch watch = {0};
    studio s = {.context = memory_watch_context(&watch)};
    if (!CHECK(s.context != NULL))
      break;
    tests[i](&s);
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  return check_done();
}
