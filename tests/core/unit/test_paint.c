/* Paints: the algebra of the Beta colour model in its two forms. */
#include "model/colour/paint.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define TINY 1e-6

static test_random numbers = {12345};

static celspan_paint random_paint(void) {
  celspan_paint paint = {.beta = random_unit(&numbers)};
  for (int c = 0; c < 3; c++) {
    paint.pigment[c] = random_unit(&numbers);
    paint.medium[c] = random_unit(&numbers);
  }
  return paint;
}

static void check_same(cs_paint a, cs_paint b, double tolerance) {
  CHECK_NEAR((double)a.beta, (double)b.beta, tolerance);
  for (int c = 0; c < 3; c++) {
    CHECK_NEAR((double)a.s[c], (double)b.s[c], tolerance);
    CHECK_NEAR((double)a.t[c], (double)b.t[c], tolerance);
  }
}

/* Light leaving a paint, as two affine terms. */
static void test_premultiplied(void) {
  celspan_paint straight = {{0.5f, 1, 0}, {1, 0.25f, 0.5f}, 0.25f};
  cs_paint paint = cs_paint_from_straight(&straight);
  check_same(paint, (cs_paint){{0.125f, 0.25f, 0}, {0.75f, 0.1875f, 0.375f}, 0.25f}, 0);
  celspan_paint clear = celspan_paint_clear();
  check_same(cs_paint_from_straight(&clear), CS_PAINT_CLEAR, 0);
}

static void test_named_paints(void) {
  celspan_paint rgb = celspan_paint_rgb(0.1f, 0.2f, 0.3f, 0.5f);
  check_same(cs_paint_from_straight(&rgb),
             (cs_paint){{0.05f, 0.1f, 0.15f}, {0.5f, 0.5f, 0.5f}, 0.5f}, TINY);
  celspan_paint gel = celspan_paint_gel(1, 0.5f, 0);
  check_same(cs_paint_from_straight(&gel), (cs_paint){{0, 0, 0}, {1, 0.5f, 0}, 0}, 0);
}

/* Mixing straight values is mixing premultiplied ones. */
static void test_mix(void) {
  for (int i = 0; i < 1000; i++) {
    celspan_paint p = random_paint(), q = random_paint();
    float u = random_unit(&numbers);
    celspan_paint mix = celspan_paint_mix(p, q, u);
    cs_paint a = cs_paint_from_straight(&p), b = cs_paint_from_straight(&q), expected;
    expected.beta = (1 - u) * a.beta + u * b.beta;
    for (int c = 0; c < 3; c++) {
      expected.s[c] = (1 - u) * a.s[c] + u * b.s[c];
      expected.t[c] = (1 - u) * a.t[c] + u * b.t[c];
    }
    CHECK(cs_paint_is_valid(&mix));
    check_same(cs_paint_from_straight(&mix), expected, TINY);
  }
}

static void test_mix_ends(void) {
  celspan_paint red = celspan_paint_rgb(1, 0, 0, 1), clear = celspan_paint_clear();
  celspan_paint half = celspan_paint_mix(red, clear, 0.5f);
  CHECK(half.beta == 0.5f && half.pigment[0] == 1 && half.medium[1] == 1);
  celspan_paint gels = celspan_paint_mix(celspan_paint_gel(1, 0, 0), clear, 0.5f);
  CHECK(gels.beta == 0 && gels.medium[0] == 1 && gels.medium[1] == 0.5f);
  celspan_paint held = celspan_paint_mix(red, clear, 7);
  CHECK(held.beta == 0);
}

static void test_fade(void) {
  cs_paint paint = {{0.5f, 0.25f, 0}, {0x1p-30f, 0.5f, 0}, 0.5f};
  check_same(cs_paint_fade(paint, 1), paint, 0);
  check_same(cs_paint_fade(paint, 0), CS_PAINT_CLEAR, 0);
  check_same(cs_paint_fade(paint, 0.5f), (cs_paint){{0.25f, 0.125f, 0}, {0.5f, 0.75f, 0.5f}, 0.25f},
             TINY);
  check_same(cs_paint_fade(CS_PAINT_CLEAR, 0.3f), CS_PAINT_CLEAR, 0);
}

static void test_pictures(void) {
  const float sample[4] = {0.25f, 2, 0, 0.5f};
  check_same(cs_paint_from_picture(sample, CELSPAN_PICTURE_PAINT),
             (cs_paint){{0.25f, 2, 0}, {0.5f, 0.5f, 0.5f}, 0.5f}, 0);
  /* Half a slide: its colour mixed with clear, which never adds light. */
  check_same(cs_paint_from_picture(sample, CELSPAN_PICTURE_GEL),
             (cs_paint){{0, 0, 0}, {0.75f, 1, 0.5f}, 0}, 0);
}

static void test_valid(void) {
  celspan_paint paint = celspan_paint_rgb(1, 0, 0.5f, 1);
  CHECK(cs_paint_is_valid(&paint));
  paint.medium[2] = -0.01f;
  CHECK(!cs_paint_is_valid(&paint));
  paint = celspan_paint_rgb(1, NAN, 0, 1);
  CHECK(!cs_paint_is_valid(&paint));
  paint = celspan_paint_rgb(1, 0, 0, 1.5f);
  CHECK(!cs_paint_is_valid(&paint));
}

/* A paint is opaque if it lets no light through, whatever its beta. */
static void test_opaque(void) {
  celspan_paint card = celspan_paint_gel(0, 0, 0);
  cs_paint paint = cs_paint_from_straight(&card);
  CHECK(cs_paint_is_opaque(&paint));
  card.medium[1] = 0.5f;
  paint = cs_paint_from_straight(&card);
  CHECK(!cs_paint_is_opaque(&paint));
}

static void test_parse(void) {
  celspan_paint paint = celspan_paint_clear();
  CHECK(celspan_paint_parse("#f80", &paint));
  CHECK(paint.beta == 1 && paint.pigment[0] == 1 && paint.pigment[2] == 0);
  CHECK_NEAR((double)paint.pigment[1], 0.2462013, 1e-6);
  CHECK(celspan_paint_parse("#Ff880080", &paint));
  CHECK_NEAR((double)paint.beta, 128.0 / 255, 1e-7);
  CHECK_NEAR((double)paint.pigment[1], 0.2462013, 1e-6);
  CHECK(celspan_paint_parse("#f808", &paint));
  CHECK_NEAR((double)paint.beta, 136.0 / 255, 1e-7);
  CHECK(paint.pigment[0] == 1);
  const char *const wrong[] = {"",       "#",       "f80",      "#f8",
                               "#fffff", "#12345g", "#1234567", "#123456789"};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    CHECK(!celspan_paint_parse(wrong[i], &paint));
  CHECK(!celspan_paint_parse(NULL, &paint));
}

int main(void) {
  test_premultiplied();
  test_named_paints();
  test_mix();
  test_mix_ends();
  test_fade();
  test_pictures();
  test_valid();
  test_opaque();
  test_parse();
  return check_done();
}
