/* engine/compose/composer.c: the result of the composer for a set of layers, whichever way it folds
 * them: by tree, layer by layer in groups; and the programs of layers that vary, however
 * many of them are cached.
 */
#include "engine/compose/composer.h"

#include "engine/compose/over_table.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

#define MOST 6000 /* layers */

static test_random numbers = {23};
static cs_layer layers[MOST];
static cs_layer_rule rules[MOST];
static bool is_here[MOST];

static bool none_is_opaque(void *painter, uint32_t image) {
  (void)painter, (void)image;
  return false;
}

/* Layers with a transmittance of at least `through`, of one kind and in no group. */
static cs_stack make_stack(size_t count, float through, cs_layer_kind kind) {
  memset(is_here, 0, sizeof is_here);
  for (size_t i = 0; i < count; i++) {
    layers[i] = (cs_layer){.group = CS_STACK_NONE, .fade = 1, .kind = (uint8_t)kind};
    rules[i] = (cs_layer_rule){{0, 0}, -1};
    rules[i].key[0] = random_bits(&numbers);
    rules[i].key[1] = random_bits(&numbers);
    for (int c = 0; c < 3; c++) {
      layers[i].t[c] = through + (1 - through) * random_unit(&numbers);
      layers[i].s[c] = (1 - layers[i].t[c]) * random_unit(&numbers);
      layers[i].front[c] = 1;
    }
  }
  return (cs_stack){.layers = layers, .rules = rules, .layer_count = count};
}

static void cross(cs_composer *composer, uint32_t layer) {
  is_here[layer] = !is_here[layer];
  cs_composer_cross(composer, layer, is_here[layer] ? 1 : -1);
}

static void check_colour(const cs_stack *stack, const cs_cell *cell) {
  double light[3] = {0}, through[3] = {1, 1, 1};
  for (size_t i = stack->layer_count; i-- > 0;)
    for (int c = 0; is_here[i] && c < 3; c++) {
      light[c] += through[c] * layers[i].s[c];
      through[c] *= layers[i].t[c];
    }
  CHECK(cell->length == 0);
  for (int c = 0; c < 3; c++)
    CHECK_NEAR(cell->colour[c], light[c], 1e-4);
  CHECK_NEAR(cell->colour[3], 1 - (through[0] + through[1] + through[2]) / 3, 1e-4);
}

/* Each of many layers alone, as in a row of many small shapes, and again, as in the row below it:
 * most of these cells are remembered. */
static void test_memo(celspan_context *context) {
  cs_stack stack = make_stack(MOST, 0, CS_LAYER_FLAT);
  cs_composer composer;
  cs_cell cell;
  uint64_t first = 0;
  for (size_t i = 0; i < MOST; i++)
    layers[i].t = cs_v4_all(0);
  CHECK(cs_composer_init(&composer, context, &stack, (cs_image_opacity){none_is_opaque, NULL}) ==
        CELSPAN_OK);
  for (int row = 0; row < 2; row++) {
    first = composer.evaluations;
    for (uint32_t layer = 0; layer < MOST; layer++) {
      cross(&composer, layer);
      cs_composer_cell(&composer, &cell);
      cross(&composer, layer);
    }
  }
  CHECK(first == MOST);
  CHECK(composer.evaluations - first < MOST * 6 / 10);
  cs_composer_finish(&composer);
}

/* Flat layers, entered and left at random, and now and then all left again. */
static void test_flats(celspan_context *context, size_t count, float through) {
  cs_stack stack = make_stack(count, through, CS_LAYER_FLAT);
  cs_composer composer;
  CHECK(cs_composer_init(&composer, context, &stack, (cs_image_opacity){none_is_opaque, NULL}) ==
        CELSPAN_OK);
  CHECK((composer.table != NULL) == cs_over_table_suits(&stack));
  for (int step = 0; step < 300; step++) {
    cs_cell cell;
    if (step % 50 == 49) {
      cs_composer_restart(&composer);
      memset(is_here, 0, sizeof is_here);
    }
    cross(&composer, (uint32_t)random_below(&numbers, (int)count));
    cs_composer_cell(&composer, &cell);
    check_colour(&stack, &cell);
  }
  cs_composer_finish(&composer);
}

/* The layers that are present, nearest first, down to where nothing shines through. */
static void check_program(const cs_stack *stack, const cs_composer *composer, const cs_cell *cell) {
  cs_program program = cs_composer_program(composer, cell);
  uint32_t at = 0;
  for (size_t i = stack->layer_count; i-- > 0;)
    if (is_here[i])
      CHECK(at < program.length && program.items[at++].layer == i);
  CHECK(at == program.length);
}

/* All sets of layers that vary, forwards and backwards, each different from the one before by one
 * layer (Gray's code), as rows of one frame: programs are discarded when there are too many, and
 * are right before and after. */
static void test_programs(celspan_context *context) {
  cs_stack stack = make_stack(14, 0.5f, CS_LAYER_SHADED);
  cs_composer composer;
  int forgotten = 0;
  size_t most = 0;
  CHECK(cs_composer_init(&composer, context, &stack, (cs_image_opacity){none_is_opaque, NULL}) ==
        CELSPAN_OK);
  for (uint32_t i = 1; i < 1u << 15; i++) {
    uint32_t place = i < 1u << 14 ? i : (1u << 15) - i;
    cs_cell cell, again;
    if (i % 64 == 0 && cs_composer_begin_row(&composer)) {
      CHECK(composer.item_count == 0);
      forgotten++;
    }
    cross(&composer, (uint32_t)__builtin_ctz(place) % 14);
    cs_composer_cell(&composer, &cell);
    check_program(&stack, &composer, &cell);
    cs_composer_cell(&composer, &again); /* from the cache */
    CHECK(again.program == cell.program && cs_composer_same(&composer, &cell, &again));
    most = composer.item_count > most ? composer.item_count : most;
  }
  CHECK(forgotten >= 6 && most < 40000);
  cs_composer_finish(&composer);
}

/* A boolean without operands, alone in its frame: a tree, and no layers. */
static void test_nothing(celspan_context *context) {
  cs_step step = {CS_STEP_LAYERS, CELSPAN_OPERATOR_UNION, 0, 0, 0};
  cs_tree tree = {0, 0, 0, 1};
  cs_stack stack = {.steps = &step, .step_depth = 1, .trees = &tree, .tree_count = 1};
  cs_composer composer;
  cs_cell cell;
  CHECK(cs_composer_init(&composer, context, &stack, (cs_image_opacity){none_is_opaque, NULL}) ==
        CELSPAN_OK);
  cs_composer_cell(&composer, &cell);
  CHECK(cell.length == 0 && cs_v4_same(cell.colour, cs_v4_all(0)));
  cs_composer_finish(&composer);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  static const size_t counts[] = {1, 4, 63, 64, 65, 191, 192, 193, 256, 257, 400};
  for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
    test_flats(context, counts[i], 0.97f); /* by tree, where there are many */
    test_flats(context, counts[i], 0.1f);  /* layer by layer */
    test_flats(context, counts[i], 0);
  }
  test_memo(context);
  test_programs(context);
  test_nothing(context);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
