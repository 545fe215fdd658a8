/* engine/compose/tree.c: the contributing layers of a set, compared with the operators applied one
 * layer at a time, for trees that begin, end and are as long as the words of a set, or nearly so.
 */
#include "engine/compose/tree.h"

#include "tests/support/check.h"
#include "tests/support/random.h"

#define MOST 320 /* layers */
#define WORDS (MOST / 64)

static test_random numbers = {17};

typedef struct range {
  uint32_t first, end;
} range;

static bool has(const uint64_t *set, uint32_t layer) { return set[layer / 64] >> layer % 64 & 1; }

static void put(uint64_t *set, uint32_t layer, bool is_present) {
  uint64_t bit = (uint64_t)1 << layer % 64;
  set[layer / 64] = is_present ? set[layer / 64] | bit : set[layer / 64] & ~bit;
}

/* ---------------------------------------------------------------- one layer at a time */

/* Whether the operator yields anything for operands that are present or not, in their order. */
static bool yields(celspan_operator op, const bool *is_here, uint32_t count) {
  bool any = false, all = count > 0, odd = false, later = false;
  for (uint32_t i = 0; i < count; i++) {
    any = any || is_here[i];
    all = all && is_here[i];
    odd = odd != is_here[i];
    later = later || (i > 0 && is_here[i]);
  }
  switch (op) {
  case CELSPAN_OPERATOR_UNION:
    return any;
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return all;
  case CELSPAN_OPERATOR_DIFFERENCE:
    return count > 0 && is_here[0] && !later;
  case CELSPAN_OPERATOR_XOR:
    return odd;
  }
  return false;
}

/* Clears the layers that one operator hides, whose operands are those ranges; returns whether it is
 * present itself. */
static bool hide(celspan_operator op, const range *operands, const bool *is_here, uint32_t count,
                 uint64_t *set) {
  bool is_present = yields(op, is_here, count);
  for (uint32_t i = 0; i < count; i++)
    for (uint32_t layer = operands[i].first; layer < operands[i].end; layer++)
      if (!is_present || (op == CELSPAN_OPERATOR_CLIP && i > 0))
        put(set, layer, false);
  return is_present;
}

/* ---------------------------------------------------------------- comparing */

static const celspan_operator operators[] = {CELSPAN_OPERATOR_UNION, CELSPAN_OPERATOR_INTERSECTION,
                                             CELSPAN_OPERATOR_DIFFERENCE, CELSPAN_OPERATOR_XOR,
                                             CELSPAN_OPERATOR_CLIP};

static const char *const densities[] = {"none", "one", "some", "all but one", "all"};

/* A set of layers: those in the range are present with the given density, others at random. */
static void fill(uint64_t *set, range tree, int density) {
  uint32_t odd_one = tree.first + (uint32_t)random_below(&numbers, (int)(tree.end - tree.first));
  for (uint32_t layer = 0; layer < MOST; layer++) {
    bool is_inside = layer >= tree.first && layer < tree.end, some = random_below(&numbers, 2);
    put(set, layer,
        !is_inside || density == 2 ? some
        : layer == odd_one         ? density == 1 || density == 4
                                   : density > 2);
  }
}

/* The steps of the tree change a set as expected, and nothing outside the tree. */
static void check_set(const cs_stack *stack, const uint64_t *before, const uint64_t *expected,
                      int density) {
  cs_tree_result results[4];
  uint64_t set[WORDS];
  memcpy(set, before, sizeof set);
  cs_tree_resolve(stack, set, results);
  if (!CHECK(memcmp(set, expected, sizeof set) == 0))
    fprintf(stderr, "  layers %u to %u, %s present\n", stack->trees->first, stack->trees->end,
            densities[density]);
}

/* An operator over layers only. */
static void check_layers(celspan_operator op, range tree) {
  uint32_t count = tree.end - tree.first;
  cs_step step = {CS_STEP_LAYERS, op, tree.first, tree.end, count};
  cs_tree only = {tree.first, tree.end, 0, 1};
  cs_stack stack = {.steps = &step, .trees = &only, .tree_count = 1, .layer_count = MOST};
  for (int density = 0; density < 5; density++) {
    uint64_t before[WORDS], expected[WORDS];
    range operands[MOST];
    bool is_here[MOST];
    fill(before, tree, density);
    memcpy(expected, before, sizeof before);
    for (uint32_t i = 0; i < count; i++) {
      operands[i] = (range){tree.first + i, tree.first + i + 1};
      is_here[i] = has(before, tree.first + i);
    }
    hide(op, operands, is_here, count, expected);
    check_set(&stack, before, expected, density);
  }
}

/* The layers of which a present operator needs one. */
static range needed_by(celspan_operator op, range tree, uint32_t middle) {
  switch (op) {
  case CELSPAN_OPERATOR_DIFFERENCE:
    return (range){tree.first, middle};
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return (range){middle, tree.end};
  default:
    return tree;
  }
}

/* An operator over two unions, which meet at a layer, with a guard. */
static void check_unions(celspan_operator op, range tree, uint32_t middle) {
  range operands[2] = {{tree.first, middle}, {middle, tree.end}};
  range needed = needed_by(op, tree, middle);
  cs_step steps[4] = {
      {CS_STEP_GUARD, CELSPAN_OPERATOR_UNION, needed.first, needed.end, 3},
      {CS_STEP_LAYERS, CELSPAN_OPERATOR_UNION, tree.first, middle, middle - tree.first},
      {CS_STEP_LAYERS, CELSPAN_OPERATOR_UNION, middle, tree.end, tree.end - middle},
      {CS_STEP_OPERATOR, op, tree.first, tree.end, 2}};
  cs_tree only = {tree.first, tree.end, 0, 4};
  cs_stack stack = {.steps = steps, .trees = &only, .tree_count = 1, .layer_count = MOST};
  for (int density = 0; density < 5; density++) {
    uint64_t before[WORDS], expected[WORDS];
    bool is_here[2] = {false, false};
    fill(before, tree, density);
    memcpy(expected, before, sizeof before);
    for (uint32_t layer = tree.first; layer < tree.end; layer++)
      is_here[layer >= middle] |= has(before, layer);
    hide(op, operands, is_here, 2, expected);
    check_set(&stack, before, expected, density);
  }
}

/* A rostrum that is an object: its frame, and a union inside. */
static void check_frame(range tree) {
  cs_step steps[2] = {
      {CS_STEP_LAYERS, CELSPAN_OPERATOR_UNION, tree.first + 1, tree.end, tree.end - tree.first - 1},
      {CS_STEP_FRAME, CELSPAN_OPERATOR_UNION, tree.first, tree.end, 1}};
  cs_tree only = {tree.first, tree.end, 0, 2};
  cs_stack stack = {.steps = steps, .trees = &only, .tree_count = 1, .layer_count = MOST};
  for (int density = 0; density < 5; density++) {
    uint64_t before[WORDS], expected[WORDS];
    fill(before, tree, density);
    memcpy(expected, before, sizeof before);
    for (uint32_t layer = tree.first; layer < tree.end && !has(before, tree.first); layer++)
      put(expected, layer, false);
    check_set(&stack, before, expected, density);
  }
}

/* Steps after a guard whose layers are absent are not taken: here they would clear layers that are
 * not of the tree. */
static void absent_operators_are_skipped(void) {
  cs_step steps[4] = {{CS_STEP_GUARD, CELSPAN_OPERATOR_UNION, 70, 72, 2},
                      {CS_STEP_LAYERS, CELSPAN_OPERATOR_INTERSECTION, 0, 72, 72},
                      {CS_STEP_OPERATOR, CELSPAN_OPERATOR_CLIP, 64, 72, 1},
                      {CS_STEP_OPERATOR, CELSPAN_OPERATOR_UNION, 64, 72, 1}};
  cs_tree only = {64, 72, 0, 4};
  cs_stack stack = {.steps = steps, .trees = &only, .tree_count = 1, .layer_count = MOST};
  uint64_t before[WORDS] = {0}, expected[WORDS] = {0};
  put(before, 3, true);
  put(before, 65, true);
  put(expected, 3, true);
  check_set(&stack, before, expected, 1);
}

int main(void) {
  static const uint32_t firsts[] = {0, 1, 63, 64, 65},
                        counts[] = {2, 3, 63, 64, 65, 127, 128, 129, 191, 192, 193};
  for (size_t i = 0; i < sizeof firsts / sizeof *firsts; i++)
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
      range tree = {firsts[i], firsts[i] + counts[k]};
      for (size_t op = 0; op < 5; op++) {
        check_layers(operators[op], tree);
        check_unions(operators[op], tree, tree.first + 1);
        check_unions(operators[op], tree, tree.first + counts[k] / 2);
        check_unions(operators[op], tree, tree.end - 1);
      }
      check_frame(tree);
    }
  absent_operators_are_skipped();
  return check_done();
}
