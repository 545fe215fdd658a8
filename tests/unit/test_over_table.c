/* engine/compose/over_table.c: the light of a set is that of its layers composited one over the
 * other, by whatever changes the set was reached, and whatever follows the last layer that counts.
 */
#include "engine/compose/over_table.h"

#include "tests/support/check.h"
#include "tests/support/random.h"

#define LEAVES 700
#define WORDS ((LEAVES + 63) / 64)

static test_random numbers = {3};

static cs_layer layers[LEAVES];
static cs_stack stack = {.layers = layers, .layer_count = LEAVES};
static uint64_t set[WORDS];
static uint8_t filled[(WORDS + 7) / 8 * 8];

/* through: the least transmittance of a layer. */
static void make_layers(float through) {
  for (int i = 0; i < LEAVES; i++)
    for (int c = 0; c < 3; c++) {
      layers[i].t[c] = through + (1 - through) * random_unit(&numbers);
      layers[i].s[c] = (1 - layers[i].t[c]) * random_unit(&numbers);
    }
}

static void put(int layer, bool is_present) {
  uint64_t bit = (uint64_t)1 << layer % 64;
  set[layer / 64] = is_present ? set[layer / 64] | bit : set[layer / 64] & ~bit;
  filled[layer / 64] = set[layer / 64] != 0;
}

static bool has(int layer) { return set[layer / 64] >> layer % 64 & 1; }

static cs_over_pair light_of(cs_over_table *table) {
  cs_over_pair light = cs_over_pair_clear;
  CHECK(cs_over_table_light(table, set, filled, &light) == CELSPAN_OK);
  return light;
}

static bool same(cs_over_pair a, cs_over_pair b) {
  return cs_v4_same(a.e, b.e) && cs_v4_same(a.t, b.t);
}

/* One layer after the other, in doubles. Returns the last layer that is seen. */
static int check_light(cs_over_pair light) {
  double e[3] = {0}, t[3] = {1, 1, 1};
  int last = LEAVES;
  while (last > 0 && (t[0] > CS_PAINT_OPAQUE || t[1] > CS_PAINT_OPAQUE || t[2] > CS_PAINT_OPAQUE))
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

/* Puts one of the first `count` leaves into the set or removes it, with the probability
 * `density`. */
static void put_any(int count, float density) {
  float place = random_unit(&numbers), depth = random_unit(&numbers);
  put((int)(place * (float)count), depth < density);
}

/* A walk from set to set; a fresh table that has seen none of them finds the same light. */
static void test_walk(celspan_context *context, float through, float density) {
  cs_over_table table, stranger;
  make_layers(through);
  CHECK(cs_over_table_init(&table, context, &stack) == CELSPAN_OK);
  for (int step = 0; step < 300; step++) {
    for (int k = 0; k < 1 + step % 9; k++)
      put_any(LEAVES, density);
    cs_over_pair light = light_of(&table);
    int last = check_light(light);
    CHECK(cs_over_table_init(&stranger, context, &stack) == CELSPAN_OK);
    CHECK(same(light, light_of(&stranger)));
    for (int k = 0; k < 5 && last > 64; k++) /* nobody sees them */
      put_any(last - 64, 0.5f);
    CHECK(last <= 64 || same(light, light_of(&table)));
    cs_over_table_finish(&stranger);
  }
  cs_over_table_finish(&table);
}

int main(void) {
  celspan_context *context;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (int i = 0; i < LEAVES; i++)
    layers[i].group = CS_STACK_NONE;
  test_walk(context, 0.9f, 0.3f);
  test_walk(context, 0.9f, 0.9f);
  test_walk(context, 0.2f, 0.5f);
  test_walk(context, 0.0f, 0.02f);
  celspan_context_destroy(context);
  return check_done();
}
