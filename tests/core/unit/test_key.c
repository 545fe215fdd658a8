/* Keys against their formulas: those of the engine in floats, those of the oracle in doubles, and
 * rows of pixels, which every instruction set makes alike. The formulas are written here once more,
 * with the rotation of chroma as angles. */
#include <math.h>
#include <string.h>

#include "engine/compose/over.h"
#include "engine/paint/over_row.h"
#include "model/scene/oracle.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define COLOURS 10000

static celspan_context *context;

/* ---------------------------------------------------------------- formulas */

static double decode(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }

static double luma(const double c[3]) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

static void chroma(const double c[3], double out[2]) {
  out[0] = (c[2] - luma(c)) / 1.8556;
  out[1] = (c[0] - luma(c)) / 1.5748;
}

static double unit(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/* The share of codes that stays; takes their spill off. */
static double expect(const celspan_key_desc *desc, const double screen[3], double c[3]) {
  double own[2], of_screen[2], most = fmax(1, fmax(c[0], fmax(c[1], c[2])));
  if (desc->by == CELSPAN_KEY_LUMA)
    return unit((luma(c) - desc->from) / (desc->to - desc->from));
  chroma(c, own);
  chroma(screen, of_screen);
  double distance = hypot(own[0] - of_screen[0], own[1] - of_screen[1]);
  double angle = fabs(atan2(own[1], own[0]) - atan2(of_screen[1], of_screen[0]));
  double size = hypot(own[0], own[1]) / hypot(of_screen[0], of_screen[1]);
  angle = angle > acos(-1) ? 2 * acos(-1) - angle : angle;
  double q = fmax(0, size * (cos(angle) - sin(angle) / tan(acos(0.5)))) * desc->spill;
  for (int i = 0; i < 3 && q > 0; i++)
    c[i] = fmin(most, fmax(0, (c[i] - q * screen[i]) / (1 - fmin(q, 0.9))));
  return unit((distance - desc->tolerance) / desc->softness);
}

/* ---------------------------------------------------------------- the three */

/* The key of an object made of nothing. */
static celspan_object *make(const celspan_key_desc *desc) {
  celspan_object *art, *key;
  CHECK(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, NULL, 0, &art) ==
        CELSPAN_OK);
  CHECK(celspan_object_key(context, art, desc, &key) == CELSPAN_OK);
  celspan_object_unref(art);
  return key;
}

static void check_colour(const celspan_grade *grade, celspan_space space, const double seen[3],
                         const double made[3], double stays, double alpha) {
  cs_oracle_sight sight = {.through = {1 - alpha, 1 - alpha, 1 - alpha}, .keep = 1};
  const cs_group group = {.fade = 1, .grade = &grade->steps, .space = (uint8_t)space};
  cs_over_pair pair = {{0}, {0}};
  for (int i = 0; i < 3; i++) {
    sight.light[i] = alpha * seen[i];
    pair.e[i] = (float)sight.light[i];
    pair.t[i] = (float)(1 - alpha);
  }
  cs_oracle_grade(grade, space, &sight);
  pair = cs_over_develop(&group, pair, 1);
  for (int i = 0; i < 3; i++) {
    CHECK_NEAR(sight.light[i], stays * alpha * made[i], 1e-6);
    CHECK_NEAR(sight.through[i], 1 - stays * alpha, 1e-6);
    CHECK_NEAR((double)pair.e[i], stays * alpha * made[i], 1e-4);
    CHECK_NEAR((double)pair.t[i], 1 - stays * alpha, 1e-4);
  }
}

static void vary(test_random *random, celspan_key_desc *desc, double screen[3]) {
  const int hue = (int)random_below(random, 3);
  for (int i = 0; i < 3; i++)
    screen[i] = i == hue ? random_between(random, 0.6, 1) : random_between(random, 0, 0.4);
  desc->by = random_below(random, 4) ? CELSPAN_KEY_CHROMA : CELSPAN_KEY_LUMA;
  desc->tolerance = random_between(random, 0, 0.4);
  desc->softness = random_between(random, 0.05, 0.5);
  desc->spill = random_between(random, 0, 1);
  desc->from = random_between(random, 0, 0.4);
  desc->to = random_between(random, 0.6, 1);
  if (random_below(random, 2)) {
    double from = desc->from;
    desc->from = desc->to;
    desc->to = from;
  }
}

static void test_formulas(celspan_space space) {
  test_random random = {(uint64_t)space};
  for (int k = 0; k < COLOURS; k++) {
    celspan_key_desc desc = CELSPAN_KEY_DESC;
    double screen[3], codes[3], numbers[3], made[3];
    vary(&random, &desc, screen);
    const celspan_paint paint = celspan_paint_rgb(
        (float)decode(screen[0]), (float)decode(screen[1]), (float)decode(screen[2]), 1);
    CHECK(celspan_texture_create_paint(context, &paint, &desc.colour) == CELSPAN_OK);
    celspan_object *key = make(&desc);
    for (int i = 0; i < 3; i++) {
      codes[i] = random_between(&random, 0.02, 1.2);
      numbers[i] = space == CELSPAN_SPACE_SRGB ? codes[i] : decode(codes[i]);
    }
    double stays = expect(&desc, screen, codes);
    for (int i = 0; i < 3; i++)
      made[i] = space == CELSPAN_SPACE_SRGB ? codes[i] : decode(codes[i]);
    check_colour(key->data->boolean->grade, space, numbers, made, stays,
                 random_between(&random, 0.05, 1));
    celspan_object_unref(key);
    celspan_texture_unref(desc.colour);
  }
}

/* ---------------------------------------------------------------- rows */

static void fill(test_random *random, cs_over_row_state *state) {
  for (int i = 0; i < CS_OVER_ROW_BATCH; i++)
    for (int c = 0; c < 4; c++) {
      bool is_end = random_below(random, 8) == 0;
      state->t[i][c] = c == 3 ? 0 : is_end ? (float)random_below(random, 2) : random_unit(random);
      state->e[i][c] = i % 31 == 0 ? 0 : 1.2f * random_unit(random) - 0.1f;
      state->e[i][c] *= i % 29 == 0 ? 1e12f : 1;
    }
}

/* Many pixels have the bits of one, whatever is in the lane without meaning. */
static void test_rows(const celspan_key_desc *desc, celspan_space space, cs_isa isa) {
  static cs_over_row_state before, made;
  test_random random = {5};
  celspan_object *key = make(desc);
  const cs_grade *grade = &key->data->boolean->grade->steps;
  const cs_group group = {.fade = 1, .grade = grade, .space = (uint8_t)space};
  for (int round = 0; round < 20; round++) {
    fill(&random, &before);
    made = before;
    CS_WIDE_CHOOSE(isa, cs_over_row_develop)(&made, CS_OVER_ROW_BATCH - round, &group, 1);
    for (int i = 0; i < CS_OVER_ROW_BATCH - round; i++) {
      cs_over_pair pair = {cs_v4_load(before.e[i]), cs_v4_load(before.t[i])};
      pair = cs_over_develop(&group, pair, 1);
      if (!CHECK(memcmp(&pair.e, made.e[i], 3 * sizeof(float)) == 0) ||
          !CHECK(memcmp(&pair.t, made.t[i], 3 * sizeof(float)) == 0))
        fprintf(stderr, "  pixel %d, isa %d, space %d\n", i, (int)isa, (int)space);
      for (int c = 0; c < 3; c++)
        CHECK(isfinite(made.e[i][c]) && made.t[i][c] >= 0 && made.t[i][c] <= 1);
    }
  }
  celspan_object_unref(key);
}

/* ---------------------------------------------------------------- refused */

static celspan_status status_of(const celspan_key_desc *desc) {
  celspan_object *art, *key = NULL;
  CHECK(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, NULL, 0, &art) ==
        CELSPAN_OK);
  celspan_status status = celspan_object_key(context, art, desc, &key);
  celspan_object_unref(key);
  celspan_object_unref(art);
  return status;
}

static void test_refused(void) {
  const double wrong[] = {-1, NAN, INFINITY, 1e13};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    celspan_key_desc desc = CELSPAN_KEY_DESC;
    desc.tolerance = wrong[i];
    CHECK(status_of(&desc) == CELSPAN_BAD_ARGUMENT);
    desc = CELSPAN_KEY_DESC;
    desc.softness = wrong[i];
    CHECK(status_of(&desc) == CELSPAN_BAD_ARGUMENT);
    desc = CELSPAN_KEY_DESC;
    desc.spill = wrong[i];
    CHECK(status_of(&desc) == CELSPAN_BAD_ARGUMENT);
    desc = CELSPAN_KEY_DESC;
    desc.by = CELSPAN_KEY_LUMA;
    desc.from = i == 0 ? NAN : wrong[i];
    CHECK(status_of(&desc) == CELSPAN_BAD_ARGUMENT);
  }
  celspan_key_desc grey = CELSPAN_KEY_DESC;
  const celspan_paint paint = celspan_paint_rgb(0.2f, 0.2f, 0.2f, 1);
  CHECK(celspan_texture_create_paint(context, &paint, &grey.colour) == CELSPAN_OK);
  CHECK(status_of(&grey) == CELSPAN_BAD_ARGUMENT);
  celspan_texture_unref(grey.colour);
  grey = CELSPAN_KEY_DESC;
  grey.by = (celspan_key_by)2;
  CHECK(status_of(&grey) == CELSPAN_BAD_ARGUMENT);
}

int main(void) {
  celspan_key_desc descs[3] = {CELSPAN_KEY_DESC, CELSPAN_KEY_DESC, CELSPAN_KEY_DESC};
  descs[1].spill = 0;
  descs[2].by = CELSPAN_KEY_LUMA;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int space = CELSPAN_SPACE_LINEAR; space <= CELSPAN_SPACE_SRGB; space++) {
    test_formulas((celspan_space)space);
    for (cs_isa isa = CS_ISA_ANY; isa <= cs_isa_best(); isa++)
      for (int i = 0; i < 3; i++)
        test_rows(&descs[i], (celspan_space)space, isa);
  }
  test_refused();
  celspan_context_destroy(context);
  return check_done();
}
