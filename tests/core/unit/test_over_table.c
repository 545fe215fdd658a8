/* engine/compose/over_table.c: the light of a set is that of its layers composited one over the
 * other, by whatever changes the set was reached, and whatever lies behind the last layer that
 * counts; and which stacks have a tree.
 */
#include "engine/compose/over_table.h"

#include <math.h>

#include "tests/support/check.h"
#include "tests/support/random.h"

#define MOST (64 * CS_OVER_TABLE_WORDS + 1) /* layers */
#define WORDS ((MOST + 63) / 64)

static test_random numbers = {5};

static cs_layer layers[MOST];
static cs_stack stack = {.layers = layers};
static uint64_t set[WORDS];

/* Layers with a transmittance of at least `through`; of many, none, if that is below 0. None of the
 * layers is present. */
static void make_layers(int count, float through) {
  stack.layer_count = (size_t)count;
  memset(set, 0, sizeof set);
  for (int i = 0; i < count; i++)
    for (int c = 0; c < 3; c++) {
      layers[i].t[c] = fmaxf(through + (1 - through) * random_unit(&numbers), 0);
      layers[i].s[c] = (1 - layers[i].t[c]) * random_unit(&numbers);
    }
}

static int count_layers(void) { return (int)stack.layer_count; }

static void put(int layer, bool is_present) {
  uint64_t bit = (uint64_t)1 << layer % 64;
  set[layer / 64] = is_present ? set[layer / 64] | bit : set[layer / 64] & ~bit;
}

static bool has(int layer) { return set[layer / 64] >> layer % 64 & 1; }

/* Puts one of the first `count` layers into the set or removes it, with the probability
 * `density`. */
static void put_any(int count, float density) {
  float place = random_unit(&numbers), depth = random_unit(&numbers);
  put((int)(place * (float)count), depth < density);
}

static cs_over_pair light_of(cs_over_table *table) {
  cs_over_pair light = cs_over_pair_clear;
  CHECK(cs_over_table_light(table, set, &light) == CELSPAN_OK);
  return light;
}

static cs_over_pair light_from_nothing(celspan_context *context) {
  cs_over_table stranger;
  CHECK(cs_over_table_init(&stranger, context, &stack) == CELSPAN_OK);
  cs_over_pair light = light_of(&stranger);
  cs_over_table_finish(&stranger);
  return light;
}

static bool same(cs_over_pair a, cs_over_pair b) {
  return cs_v4_same(a.e, b.e) && cs_v4_same(a.t, b.t);
}

/* One layer after the other, in doubles. Returns the last layer that is seen: nothing behind it
 * shines through, whatever the rounding. */
static int check_light(cs_over_pair light) {
  const double opaque = 0.999 * (double)CS_PAINT_OPAQUE;
  double e[3] = {0}, t[3] = {1, 1, 1};
  int last = count_layers();
  while (last > 0 && (t[0] > opaque || t[1] > opaque || t[2] > opaque))
    if (has(--last))
      for (int c = 0; c < 3; c++) {
        e[c] += t[c] * (double)layers[last].s[c];
        t[c] *= (double)layers[last].t[c];
      }
  for (int c = 0; c < 3; c++) {
    CHECK_NEAR((double)light.e[c], e[c], 2e-5);
    CHECK_NEAR((double)light.t[c], t[c], 2e-5);
  }
  return last;
}

/* A walk from set to set. A fresh table that has seen none of them finds the same light, and so
 * does one with other layers behind the last that is seen. */
static void test_walk(celspan_context *context, int count, float through, float density) {
  cs_over_table table;
  int hidden = 0;
  make_layers(count, through);
  CHECK(cs_over_table_init(&table, context, &stack) == CELSPAN_OK);
  for (int step = 0; step < 300; step++) {
    for (int k = 0; k < (step == 0 ? count : 1 + step % 9); k++)
      put_any(count, density);
    cs_over_pair light = light_of(&table);
    int last = check_light(light);
    CHECK(same(light, light_from_nothing(context)));
    CHECK(same(light, light_of(&table)));
    hidden += last > 0;
    for (int k = 0; k < 5 && last > 0; k++)
      put_any(last, 0.5f);
    CHECK(same(light, light_of(&table)));
    CHECK(same(light, light_from_nothing(context)));
  }
  CHECK((hidden > 100) == (through < 0.9f || (density > 0.8f && count > 190)));
  cs_over_table_finish(&table);
}

/* Behind all others lies an opaque layer. */
static void test_background(celspan_context *context) {
  make_layers(1000, 0.95f);
  layers[0].t = cs_v4_all(0);
  put(0, true);
  for (int i = 0; i < 60; i++)
    put_any(1000, 1);
  cs_over_pair light = light_from_nothing(context);
  check_light(light);
  CHECK(light.t[0] == 0);
}

static void test_choice(void) {
  make_layers(256, 0.9f);
  CHECK(cs_over_table_suits(&stack));
  layers[0].t = cs_v4_all(0); /* a single background does not count */
  CHECK(cs_over_table_suits(&stack));
  stack.layer_count = 190;
  CHECK(!cs_over_table_suits(&stack)); /* few layers */
  stack.layer_count = 256;
  for (int i = 0; i < 256; i++)
    layers[i].t = cs_v4_all(0.6f);
  CHECK(!cs_over_table_suits(&stack)); /* few of them are seen */
  make_layers(MOST, 0.9f);
  CHECK(!cs_over_table_suits(&stack)); /* too many to compare each time */
}

int main(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int i = 0; i < MOST; i++)
    layers[i].group = CS_STACK_NONE;
  test_walk(context, 700, 0.98f, 0.2f);
  test_walk(context, 1000, 0.9f, 0.9f);
  test_walk(context, 4500, 0.98f, 0.95f);
  test_background(context);
  test_choice();
  celspan_context_destroy(context);
  return check_done();
}
