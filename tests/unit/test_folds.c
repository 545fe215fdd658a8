/* compose/folds.c: the light of a set is that of its leaves one over the other, however the set was
 * reached and whatever lies behind the end of the light. */
#include "compose/folds.h"

#include "tests/support/check.h"

#define LEAVES 700
#define WORDS ((LEAVES + 63) / 64)

static uint32_t state = 3;

static float random_unit(void) {
  state = state * 1664525u + 1013904223u;
  return (float)(state >> 8) * 0x1p-24f;
}

static cs_leaf leaves[LEAVES];
static cs_stack stack = {.leaves = leaves, .leaf_count = LEAVES};
static uint64_t set[WORDS];
static uint8_t filled[(WORDS + 7) / 8 * 8];

/* through: what every leaf lets through at least. */
static void make_leaves(float through) {
  for (int i = 0; i < LEAVES; i++)
    for (int c = 0; c < 3; c++) {
      leaves[i].t[c] = through + (1 - through) * random_unit();
      leaves[i].s[c] = (1 - leaves[i].t[c]) * random_unit();
    }
}

static void put(int leaf, bool is_present) {
  uint64_t bit = (uint64_t)1 << leaf % 64;
  set[leaf / 64] = is_present ? set[leaf / 64] | bit : set[leaf / 64] & ~bit;
  filled[leaf / 64] = set[leaf / 64] != 0;
}

static bool has(int leaf) { return set[leaf / 64] >> leaf % 64 & 1; }

static cs_glimpse light_of(cs_folds *folds) {
  cs_glimpse light = cs_glimpse_clear;
  CHECK(cs_folds_light(folds, set, filled, &light) == CELSPAN_OK);
  return light;
}

static bool same(cs_glimpse a, cs_glimpse b) {
  return cs_v4_same(a.e, b.e) && cs_v4_same(a.t, b.t);
}

/* One leaf after the other, in doubles. Returns the last leaf that is seen. */
static int check_light(cs_glimpse light) {
  double e[3] = {0}, t[3] = {1, 1, 1};
  int last = LEAVES;
  while (last > 0 && (t[0] > CS_PAINT_OPAQUE || t[1] > CS_PAINT_OPAQUE || t[2] > CS_PAINT_OPAQUE))
    if (has(--last))
      for (int c = 0; c < 3; c++) {
        e[c] += t[c] * (double)leaves[last].s[c];
        t[c] *= (double)leaves[last].t[c];
      }
  for (int c = 0; c < 3; c++) {
    CHECK_NEAR((double)light.e[c], e[c], 2e-5);
    CHECK_NEAR((double)light.t[c], t[c], 2e-5);
  }
  return last;
}

/* A walk from set to set; a stranger who has seen none of them finds the same light. */
static void test_walk(celspan_context *context, float through, float density) {
  cs_folds folds, stranger;
  make_leaves(through);
  CHECK(cs_folds_init(&folds, context, &stack) == CELSPAN_OK);
  for (int step = 0; step < 300; step++) {
    for (int k = 0; k < 1 + step % 9; k++)
      put((int)(random_unit() * LEAVES), random_unit() < density);
    cs_glimpse light = light_of(&folds);
    int last = check_light(light);
    CHECK(cs_folds_init(&stranger, context, &stack) == CELSPAN_OK);
    CHECK(same(light, light_of(&stranger)));
    for (int k = 0; k < 5 && last > 64; k++) /* nobody sees them */
      put((int)(random_unit() * (float)(last - 64)), random_unit() < 0.5f);
    CHECK(last <= 64 || same(light, light_of(&folds)));
    cs_folds_finish(&stranger);
  }
  cs_folds_finish(&folds);
}

int main(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int i = 0; i < LEAVES; i++)
    leaves[i].group = CS_STACK_NONE;
  test_walk(context, 0.9f, 0.3f);
  test_walk(context, 0.9f, 0.9f);
  test_walk(context, 0.2f, 0.5f);
  test_walk(context, 0.0f, 0.02f);
  celspan_context_destroy(context);
  return check_done();
}
