/* Grades against their formulas: those of the engine and those of the oracle, both in doubles, and
 * what the folds make of them in floats. The formulas are written here once more, one by one. */
#include <math.h>
#include <string.h>

#include "engine/compose/over.h"
#include "model/scene/oracle.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define COLOURS 10000

static celspan_context *context;

/* ---------------------------------------------------------------- formulas */

typedef void (*step)(const celspan_grade_desc *desc, celspan_space space, double c[3]);

static void exposure(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  (void)space;
  for (int i = 0; i < 3; i++)
    c[i] *= pow(2, desc->exposure);
}

static void cdl(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  (void)space;
  for (int i = 0; i < 3; i++) {
    const double held = c[i] * desc->slope[i] + desc->offset[i];
    c[i] = held <= 0 ? 0 : pow(held, desc->power[i]);
  }
}

static void contrast(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  double pivot = space == CELSPAN_SPACE_SRGB ? 0.46 : 0.18;
  pivot = desc->has_pivot ? desc->pivot : pivot;
  for (int i = 0; i < 3; i++)
    c[i] = (c[i] - pivot) * desc->contrast + pivot;
}

static void by_rows(const double m[3][3], double c[3]) {
  const double r = c[0], g = c[1], b = c[2];
  for (int i = 0; i < 3; i++)
    c[i] = m[i][0] * r + m[i][1] * g + m[i][2] * b;
}

static void saturation(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  const double s = desc->saturation;
  const double m[3][3] = {{0.2126 + 0.7874 * s, 0.7152 - 0.7152 * s, 0.0722 - 0.0722 * s},
                          {0.2126 - 0.2126 * s, 0.7152 + 0.2848 * s, 0.0722 - 0.0722 * s},
                          {0.2126 - 0.2126 * s, 0.7152 - 0.7152 * s, 0.0722 + 0.9278 * s}};
  (void)space;
  by_rows(m, c);
}

static void hue(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  const double k = cos(desc->hue_radians), s = sin(desc->hue_radians);
  const double m[3][3] = {{0.2126 + k * 0.7874 - s * 0.2126, 0.7152 - k * 0.7152 - s * 0.7152,
                           0.0722 - k * 0.0722 + s * 0.9278},
                          {0.2126 - k * 0.2126 + s * 0.143, 0.7152 + k * 0.2848 + s * 0.140,
                           0.0722 - k * 0.0722 - s * 0.283},
                          {0.2126 - k * 0.2126 - s * 0.7874, 0.7152 - k * 0.7152 + s * 0.7152,
                           0.0722 + k * 0.9278 + s * 0.0722}};
  (void)space;
  by_rows(m, c);
}

static void balance(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  const double r = pow(2, desc->temperature / 2), g = pow(2, -desc->tint / 2);
  const double b = pow(2, -desc->temperature / 2);
  const double white = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  (void)space;
  c[0] *= r / white;
  c[1] *= g / white;
  c[2] *= b / white;
}

static void bend(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  (void)space;
  for (int i = 0; i < 3; i++)
    c[i] = (c[i] < 0 ? -1 : 1) * pow(fabs(c[i]), 1 / desc->gamma);
}

static void matrix(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  const double from[3] = {c[0], c[1], c[2]};
  (void)space;
  for (int i = 0; i < 3 && desc->has_matrix; i++)
    c[i] = desc->matrix[i][0] * from[0] + desc->matrix[i][1] * from[1] +
           desc->matrix[i][2] * from[2] + desc->matrix[i][3];
}

static const step steps[] = {exposure, cdl, contrast, saturation, hue, balance, bend, matrix};
#define STEPS (sizeof steps / sizeof *steps)

/* ---------------------------------------------------------------- random grades */

static void vary_step(test_random *random, size_t k, celspan_grade_desc *desc) {
  if (steps[k] == exposure)
    desc->exposure = random_between(random, -2, 2);
  else if (steps[k] == cdl)
    for (int i = 0; i < 3; i++) {
      desc->slope[i] = random_between(random, 0, 2);
      desc->offset[i] = random_between(random, -0.3, 0.3);
      desc->power[i] = random_between(random, 1, 3);
    }
  else if (steps[k] == contrast)
    desc->contrast = random_between(random, 0, 2);
  else if (steps[k] == saturation)
    desc->saturation = random_between(random, 0, 2);
  else if (steps[k] == hue)
    desc->hue_radians = random_between(random, -7, 7);
  else if (steps[k] == balance) {
    desc->temperature = random_between(random, -1, 1);
    desc->tint = random_between(random, -1, 1);
  } else if (steps[k] == bend)
    desc->gamma = random_between(random, 0.5, 3);
  else {
    desc->has_matrix = true;
    for (int i = 0; i < 12; i++)
      desc->matrix[i / 4][i % 4] = random_between(random, -1, 1);
  }
}

static void random_colour(test_random *random, double c[3]) {
  for (int i = 0; i < 3; i++)
    c[i] = random_between(random, -0.2, 1.5);
}

/* What the engine and the oracle make of a colour of which `alpha` is there. */
static void check_grade(const celspan_grade *grade, celspan_space space, const double colour[3],
                        const double expected[3], double alpha) {
  double c[3];
  cs_oracle_sight sight = {.through = {1 - alpha, 1 - alpha, 1 - alpha}, .keep = 1};
  const cs_group group = {.fade = 1, .grade = &grade->steps, .space = (uint8_t)space};
  cs_over_pair pair = {{0}, {0}};
  memcpy(c, colour, sizeof c);
  for (int i = 0; i < 3; i++) {
    sight.light[i] = alpha * colour[i];
    pair.e[i] = (float)sight.light[i];
    pair.t[i] = (float)(1 - alpha);
  }
  cs_grade_colour(&grade->steps, space, c);
  cs_oracle_grade(grade, space, &sight);
  const cs_over_pair made = cs_over_develop(&group, pair, 1);
  for (int i = 0; i < 3; i++) {
    const double size = fmax(1, fabs(expected[i]));
    CHECK_NEAR(c[i], expected[i], 1e-6 * size);
    CHECK_NEAR(sight.light[i], alpha * expected[i], 1e-6 * size);
    CHECK_NEAR(made.e[i], alpha * expected[i], 1e-4 * size);
    CHECK(made.t[i] == pair.t[i]);
  }
}

/* What the steps from `first` to `last` make of a colour. False: a root is met where it is steep,
 * so that floats, and colours that were premultiplied, are farther apart than their formulas. */
static bool expect(size_t first, size_t last, const celspan_grade_desc *desc, celspan_space space,
                   double colour[3]) {
  for (size_t k = first; k <= last; k++) {
    bool is_steep = steps[k] == bend && desc->gamma > 1;
    for (int c = 0; c < 3 && is_steep; c++)
      if (fabs(colour[c]) < 0.01)
        return false;
    steps[k](desc, space, colour);
  }
  return true;
}

static void test_steps(size_t first, size_t last, celspan_space space) {
  test_random random = {first * 100 + last};
  for (int i = 0; i < COLOURS; i++) {
    celspan_grade_desc desc = CELSPAN_GRADE_DESC;
    celspan_grade *grade;
    double colour[3], expected[3];
    for (size_t k = first; k <= last; k++)
      vary_step(&random, k, &desc);
    desc.has_pivot = i % 3 == 0;
    desc.pivot = random_between(&random, 0, 1);
    double alpha = random_between(&random, 0.05, 1);
    random_colour(&random, colour);
    memcpy(expected, colour, sizeof expected);
    if (!expect(first, last, &desc, space, expected))
      continue;
    CHECK(celspan_grade_create(context, &desc, &grade) == CELSPAN_OK);
    check_grade(grade, space, colour, expected, alpha);
    celspan_grade_unref(grade);
  }
}

/* ---------------------------------------------------------------- curves */

static size_t random_curve(test_random *random, celspan_point points[8]) {
  size_t count = 2 + (size_t)random_below(random, 7);
  double x = random_between(random, -0.5, 0.3), y = random_between(random, -0.5, 0.5);
  bool rises = random_below(random, 2);
  for (size_t i = 0; i < count; i++) {
    points[i] = (celspan_point){x, y};
    x += random_between(random, 0.01, 0.5);
    double rise = random_between(random, 0, 0.6);
    bool is_level = random_below(random, 5) == 0;
    y += is_level ? 0 : rises ? rise : -rise;
  }
  return count;
}

static double through(const celspan_grade *grade, double x) {
  double c[3] = {x, x, x};
  cs_grade_colour(&grade->steps, CELSPAN_SPACE_LINEAR, c);
  return c[1];
}

/* Through all points, without turning back between them, smoothly, and straight beyond them. */
static void check_curve(const celspan_grade *grade, const celspan_point *p, size_t count) {
  const double e = 1e-6;
  for (size_t i = 0; i < count; i++)
    CHECK_NEAR(through(grade, p[i].x), p[i].y, 1e-9);
  for (size_t i = 0; i + 1 < count; i++)
    for (int k = 0; k < 16; k++) {
      double a = p[i].x + (p[i + 1].x - p[i].x) * k / 16, b = a + (p[i + 1].x - p[i].x) / 16;
      double turn = (through(grade, b) - through(grade, a)) * (p[i + 1].y - p[i].y);
      CHECK(turn >= -1e-12);
    }
  for (size_t i = 0; i < count; i++) {
    double before = (through(grade, p[i].x) - through(grade, p[i].x - e)) / e;
    double behind = (through(grade, p[i].x + e) - through(grade, p[i].x)) / e;
    CHECK_NEAR(before, behind, 0.02 + 1e-3 * fabs(before));
  }
  double start = through(grade, p[0].x - 1) - p[0].y, end = through(grade, p[count - 1].x + 1);
  CHECK_NEAR(through(grade, p[0].x - 2) - p[0].y, 2 * start, 1e-9);
  CHECK_NEAR(through(grade, p[count - 1].x + 2) - p[count - 1].y, 2 * (end - p[count - 1].y), 1e-9);
}

static void test_curves(void) {
  test_random random = {7};
  for (int i = 0; i < COLOURS; i++) {
    celspan_grade_desc desc = CELSPAN_GRADE_DESC;
    celspan_grade *grade;
    celspan_point points[8];
    double colour[3], expected[3];
    size_t count = random_curve(&random, points);
    for (int c = 0; c < 3; c++) {
      desc.curve[c] = points;
      desc.curve_count[c] = count;
    }
    CHECK(celspan_grade_create(context, &desc, &grade) == CELSPAN_OK);
    if (i % 20 == 0)
      check_curve(grade, points, count);
    random_colour(&random, colour);
    for (int c = 0; c < 3; c++)
      expected[c] = through(grade, colour[c]);
    check_grade(grade, CELSPAN_SPACE_LINEAR, colour, expected, random_between(&random, 0.05, 1));
    celspan_grade_unref(grade);
  }
}

/* ---------------------------------------------------------------- tables */

/* A table of random values, and the same by its eight corners. */
static void test_cubes(bool is_solid) {
  test_random random = {11};
  for (int i = 0; i < COLOURS / 100; i++) {
    float values[125][3];
    const size_t side = 2 + (size_t)random_below(&random, 4);
    cs_cube cube = {.is_solid = is_solid,
                    .side = side,
                    .domain = {-0.5, 0, 0.1, 1, 2, 0.9},
                    .values = values,
                    .count = is_solid ? side * side * side : side};
    celspan_grade grade = {
        .steps = {.exponent = 1, .cube = &cube, .cube_space = CELSPAN_SPACE_SRGB},
        .desc = CELSPAN_GRADE_DESC};
    if (i % 2)
      grade.desc.lut_space = grade.steps.cube_space = CELSPAN_SPACE_LINEAR;
    for (size_t k = 0; k < cube.count; k++)
      for (int c = 0; c < 3; c++)
        values[k][c] = (float)random_between(&random, -0.2, 1.2);
    for (int k = 0; k < 100; k++) {
      double colour[3], expected[3];
      random_colour(&random, colour);
      cs_oracle_sight sight = {.light = {colour[0], colour[1], colour[2]}, .keep = 1};
      cs_oracle_grade(&grade, CELSPAN_SPACE_LINEAR, &sight);
      memcpy(expected, sight.light, sizeof expected);
      check_grade(&grade, CELSPAN_SPACE_LINEAR, colour, expected, random_between(&random, 0.05, 1));
    }
  }
}

/* ---------------------------------------------------------------- steps of codes */

static double code_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

/* In codes and in light, each colour has the code of the band that its code lies in, and codes at
 * the border of two bands have the upper one. */
static void check_step(const celspan_grade *grade, celspan_space space, double value, int k) {
  const double step_code = k / (grade->desc.steps - 1.0), seen[3] = {value, value, value};
  const double light =
      step_code <= 0.04045 ? step_code / 12.92 : pow((step_code + 0.055) / 1.055, 2.4);
  const double made = space == CELSPAN_SPACE_SRGB ? step_code : light;
  check_grade(grade, space, seen, (double[3]){made, made, made}, 0.5);
}

static void test_rounding(void) {
  for (int count = 2; count <= CS_GRADE_STEPS; count += count < 8 ? 1 : 62) {
    celspan_grade_desc desc = CELSPAN_GRADE_DESC;
    celspan_grade *grade;
    desc.steps = count;
    CHECK(celspan_grade_create(context, &desc, &grade) == CELSPAN_OK);
    for (int k = 0; k < count; k++) {
      check_step(grade, CELSPAN_SPACE_SRGB, (k + 0.5) / count, k);
      check_step(grade, CELSPAN_SPACE_SRGB, (double)k / count, k);
    }
    for (int i = -20; i <= 150; i++) {
      const double band = code_of(i / 100.0) * count, k = floor(band);
      if (band - k > 0.01 && band - k < 0.99)
        check_step(grade, CELSPAN_SPACE_LINEAR, i / 100.0, (int)fmax(0, fmin(k, count - 1)));
    }
    celspan_grade_unref(grade);
  }
  celspan_grade_desc wrong = CELSPAN_GRADE_DESC;
  celspan_grade *none;
  wrong.steps = 1;
  CHECK(celspan_grade_create(context, &wrong, &none) == CELSPAN_BAD_ARGUMENT);
}

/* ---------------------------------------------------------------- the ends */

/* A grade that does nothing changes no bit; nothing stays nothing; light without alpha is graded as
 * far as it shines. */
static void test_ends(void) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  celspan_grade *same, *twice;
  CHECK(celspan_grade_create(context, &desc, &same) == CELSPAN_OK);
  desc.exposure = 1;
  CHECK(celspan_grade_create(context, &desc, &twice) == CELSPAN_OK);
  CHECK(same->hash.a != twice->hash.a);
  for (int i = 0; i <= 64; i++) {
    double c[3] = {i / 64.0, -i / 3.0, i * 1e-6}, before[3];
    memcpy(before, c, sizeof c);
    cs_grade_colour(&same->steps, CELSPAN_SPACE_SRGB, c);
    CHECK(memcmp(c, before, sizeof c) == 0);
  }
  float none[3] = {0, 0, 0}, glow[3] = {0.25f, 0.5f, 0};
  cs_grade_light(&twice->steps, CELSPAN_SPACE_LINEAR, 0, none);
  cs_grade_light(&twice->steps, CELSPAN_SPACE_LINEAR, 0, glow);
  CHECK(none[0] == 0 && none[1] == 0 && none[2] == 0);
  CHECK(glow[0] == 0.5f && glow[1] == 1 && glow[2] == 0);
  celspan_grade_unref(same);
  celspan_grade_unref(twice);
}

/* However far colours are driven, they stay finite. */
static void test_far(void) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  celspan_grade *grade;
  desc.exposure = CELSPAN_GRADE_STOPS;
  desc.contrast = desc.saturation = 1e12;
  desc.gamma = 1.0 / CELSPAN_GRADE_GAMMA;
  desc.has_matrix = true;
  for (int i = 0; i < 12; i++)
    desc.matrix[i / 4][i % 4] = i % 2 ? 1e12 : -1e12;
  CHECK(celspan_grade_create(context, &desc, &grade) == CELSPAN_OK);
  double c[3] = {1e12, -1e12, 0};
  for (int i = 0; i < 8; i++) {
    cs_grade_colour(&grade->steps, CELSPAN_SPACE_LINEAR, c);
    for (int k = 0; k < 3; k++)
      CHECK(fabs(c[k]) <= CS_GRADE_MOST);
  }
  celspan_grade_unref(grade);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (size_t k = 0; k < STEPS; k++)
    test_steps(k, k, k % 2 ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR);
  test_steps(0, STEPS - 1, CELSPAN_SPACE_LINEAR);
  test_steps(0, STEPS - 1, CELSPAN_SPACE_SRGB);
  test_curves();
  test_cubes(false);
  test_cubes(true);
  test_rounding();
  test_ends();
  test_far();
  celspan_context_destroy(context);
  return check_done();
}
