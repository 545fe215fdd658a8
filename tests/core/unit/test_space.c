/* Working spaces against their formulas: the oracle's in doubles, the engine's in floats. */
#include <math.h>

#include "engine/compose/over.h"
#include "model/scene/oracle.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define PAIRS 10000

/* ---------------------------------------------------------------- formulas */

static double coded(double x) {
  return x > 0.0031308 ? 1.055 * pow(x, 1 / 2.4) - 0.055 : x * 12.92;
}

static double light(double x) { return x > 0.04045 ? pow((x + 0.055) / 1.055, 2.4) : x / 12.92; }

static double curve(celspan_space to, double x) {
  double y = to == CELSPAN_SPACE_SRGB ? coded(fabs(x)) : light(fabs(x));
  return x < 0 ? -y : y;
}

static double left(celspan_space to, double s, double t) {
  double share = fmax(1 - t, fmin(fabs(s), 1));
  return share > 0 ? share * curve(to, s / share) : s;
}

/* ---------------------------------------------------------------- tests */

/* A sight that transmits more or less than its light needs; sometimes its light is impossible. */
static void random_sight(test_random *random, double least, cs_oracle_sight *out) {
  *out = (cs_oracle_sight){.keep = 1};
  for (int c = 0; c < 3; c++) {
    out->through[c] = 1 - random_between(random, least, 1);
    out->light[c] = random_between(random, -0.1, 1.5) * (1 - out->through[c]);
  }
}

static void test_oracle(celspan_space to) {
  test_random random = {1};
  for (int i = 0; i < PAIRS; i++) {
    cs_oracle_sight sight;
    random_sight(&random, 0, &sight);
    sight.keep = i % 2 ? 1 : random_between(&random, 0, 1);
    const cs_oracle_sight seen = cs_oracle_leave(to, &sight);
    for (int c = 0; c < 3; c++) {
      CHECK_NEAR(seen.light[c], left(to, sight.light[c], sight.keep * sight.through[c]), 1e-6);
      CHECK(seen.through[c] == sight.through[c]);
    }
  }
}

static void test_engine(celspan_space to) {
  test_random random = {2};
  const cs_group group = {.fade = 1, .converts = (uint8_t)to};
  for (int i = 0; i < PAIRS; i++) {
    cs_oracle_sight sight;
    random_sight(&random, 0.05, &sight);
    cs_over_pair pair = {{0}, {0}};
    for (int c = 0; c < 3; c++) {
      pair.e[c] = (float)sight.light[c];
      pair.t[c] = (float)sight.through[c];
    }
    const cs_over_pair made = cs_over_develop(&group, pair, 0.5f);
    for (int c = 0; c < 3; c++) {
      CHECK_NEAR(made.e[c], left(to, sight.light[c], sight.through[c]), 1e-4);
      CHECK(made.t[c] == pair.t[c]);
    }
  }
}

/* White and black stay to the bit, however much of them is there; nothing at all stays nothing. */
static void test_ends(celspan_space to) {
  for (int i = 0; i <= 16; i++) {
    float share = (float)i / 16;
    CHECK(cs_space_channel(to, share, share) == share);
    CHECK(cs_space_channel(to, 0, share) == 0);
  }
  CHECK(cs_space_channel(to, 2, 1) > 1);
  CHECK(cs_space_channel(to, 0.5f, 0) == 0.5f); /* light without matte */
  CHECK(cs_space_channel(to, -0.5f, 1) == -cs_space_channel(to, 0.5f, 1));
}

/* Many channels together have the bits of each one by itself: any number of them, with all
 * instructions, and beyond the tables of powers, too. */
static void test_channels(celspan_space to, cs_isa isa) {
  const float odd[] = {0, -0.0f, -2, 1e-30f, -1e-30f, 3e6f, 1e9f, INFINITY, -INFINITY, NAN};
  const int32_t odds = (int32_t)(sizeof odd / sizeof *odd);
  float s[200], shares[200], wanted[200];
  test_random random = {4};
  for (int32_t count = 0; count <= 200; count++) {
    for (int32_t i = 0; i < count; i++) {
      s[i] = (float)random_between(&random, -0.2, 1.2);
      shares[i] = i % 7 == 0 ? 0 : (float)random_between(&random, 0, 1);
      if (count % 3 == 0 && i % 11 == 0)
        s[i] = odd[(count + i) % odds];
      wanted[i] = cs_space_channel(to, s[i], shares[i]);
    }
    CS_WIDE_CHOOSE(isa, cs_space_channels)(to, shares, count, s);
    CHECK(memcmp(s, wanted, (size_t)count * sizeof *s) == 0);
  }
}

/* So have the colours of pixels, of which some are black; the fourth channel stays. */
static void test_pixels(celspan_space to, cs_isa isa) {
  enum { MOST = 150 };
  float s[4 * MOST], shares[4 * MOST], wanted[4 * MOST];
  test_random random = {5};
  for (int32_t count = 0; count <= MOST; count++) {
    for (int32_t i = 0; i < 4 * count; i++) {
      const bool is_black = (i / 4 + count) % 5 < count % 4, is_beyond = (i + count) % 97 == 0;
      s[i] = is_beyond                         ? NAN
             : is_black || (i + count) % 9 < 3 ? 0
                                               : (float)random_between(&random, -0.2, 1.2);
      shares[i] = i % 3 == 0 ? 0 : (float)random_between(&random, 0, 1);
      wanted[i] = i % 4 == 3 ? s[i] : cs_space_channel(to, s[i], shares[i]);
    }
    CS_WIDE_CHOOSE(isa, cs_space_pixels)(to, shares, count, s);
    CHECK(memcmp(s, wanted, 4 * (size_t)count * sizeof *s) == 0);
  }
}

static void test_paints(void) {
  test_random random = {3};
  for (int i = 0; i < PAIRS; i++) {
    celspan_paint straight = {.beta = (float)random_between(&random, 0.05, 1)};
    for (int c = 0; c < 3; c++) {
      straight.pigment[c] = (float)random_between(&random, 0, 1);
      straight.medium[c] = (float)random_between(&random, 0, 1);
    }
    const cs_paint paint = cs_paint_from_straight(&straight);
    const cs_paint linear = cs_space_paint(CELSPAN_SPACE_LINEAR, paint);
    const cs_paint codes = cs_space_paint(CELSPAN_SPACE_SRGB, paint);
    for (int c = 0; c < 3; c++) {
      CHECK(linear.s[c] == paint.s[c] && codes.t[c] == paint.t[c]);
      CHECK_NEAR(codes.s[c], (double)straight.beta * coded((double)straight.pigment[c]), 1e-6);
    }
  }
}

static void test_inside(void) {
  CHECK(cs_space_inside(CELSPAN_SPACE_AROUND, CELSPAN_SPACE_AROUND) == CELSPAN_SPACE_LINEAR);
  CHECK(cs_space_inside(CELSPAN_SPACE_AROUND, CELSPAN_SPACE_SRGB) == CELSPAN_SPACE_SRGB);
  CHECK(cs_space_inside(CELSPAN_SPACE_LINEAR, CELSPAN_SPACE_SRGB) == CELSPAN_SPACE_LINEAR);
}

int main(void) {
  for (int to = CELSPAN_SPACE_LINEAR; to <= CELSPAN_SPACE_SRGB; to++) {
    test_oracle((celspan_space)to);
    test_engine((celspan_space)to);
    test_ends((celspan_space)to);
    for (int isa = CS_ISA_ANY; isa <= (int)cs_isa_best(); isa++) {
      test_channels((celspan_space)to, (cs_isa)isa);
      test_pixels((celspan_space)to, (cs_isa)isa);
    }
  }
  test_paints();
  test_inside();
  return check_done();
}
