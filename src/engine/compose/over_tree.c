#include "engine/compose/over_tree.h"

#include <math.h>

#define LEAST_WORDS 4 /* of a stack: fewer are quickly folded by table */

/* ---------------------------------------------------------------- the choice */

/* What a layer lets through in its clearest channel; of one that lets nothing through, the least
 * that counts. */
static double let_through(const cs_layer *layer) {
  float most = layer->t[0] > layer->t[1] ? layer->t[0] : layer->t[1];
  most = layer->t[2] > most ? layer->t[2] : most;
  return most > CS_PAINT_OPAQUE ? (double)most : (double)CS_PAINT_OPAQUE;
}

/* Nothing shines through after sixteen halvings. Where the layers halve the light less than once in
 * two, on the average, more than 32 are seen in a place, if as many lie there. */
bool cs_over_tree_suits(const cs_stack *stack) {
  size_t words = cs_stack_words(stack), halvings = 0;
  double through = 1;
  if (words < LEAST_WORDS || words > CS_OVER_TREE_WORDS)
    return false;
  for (size_t i = 0; i < stack->layer_count; i++) {
    int exponent;
    through = frexp(through * let_through(&stack->layers[i]), &exponent);
    halvings += (size_t)-exponent;
  }
  return halvings < stack->layer_count / 2;
}

/* ---------------------------------------------------------------- life */

static inline size_t group_count(size_t nodes) { return (nodes + CS_OVER_FOUR - 1) / CS_OVER_FOUR; }

/* Every tier but the last is filled up to a multiple of four, with clear nodes. */
static celspan_status make_nodes(cs_over_tree *tree) {
  size_t counts[CS_OVER_TREE_TIERS];
  size_t nodes = CS_OVER_QUADS * tree->word_count;
  for (; nodes > 1; nodes = group_count(nodes)) {
    counts[tree->top] = CS_OVER_FOUR * group_count(nodes);
    tree->node_count += counts[tree->top++];
  }
  counts[tree->top] = 1;
  tree->node_count++;
  CS_TRY(CS_MAKE(tree->context, tree->nodes, tree->node_count));
  for (size_t i = 0; i < tree->node_count; i++)
    tree->nodes[i] = cs_over_pair_clear;
  cs_over_pair *next = tree->nodes;
  for (int tier = 0; tier <= tree->top; next += counts[tier++])
    tree->tiers[tier] = next;
  return CELSPAN_OK;
}

celspan_status cs_over_tree_init(cs_over_tree *tree, celspan_context *context,
                                 const cs_stack *stack) {
  *tree = (cs_over_tree){.context = context, .stack = stack, .word_count = cs_stack_words(stack)};
  CS_TRY(CS_MAKE(context, tree->words, tree->word_count));
  CS_TRY(CS_MAKE(context, tree->quads, tree->word_count));
  return make_nodes(tree);
}

void cs_over_tree_finish(cs_over_tree *tree) {
  if (!tree->context)
    return;
  cs_memory *memory = tree->context->memory;
  for (size_t i = 0; tree->quads && i < tree->word_count; i++)
    cs_over_quads_free(tree->quads[i], memory);
  cs_mem_free(memory, tree->quads, tree->word_count * sizeof *tree->quads);
  cs_mem_free(memory, tree->words, tree->word_count * sizeof *tree->words);
  cs_mem_free(memory, tree->nodes, tree->node_count * sizeof *tree->nodes);
  *tree = (cs_over_tree){0};
}

/* ---------------------------------------------------------------- changes */

static inline cs_over_pair join(const cs_over_pair *four) {
  return cs_over_pair_over(cs_over_pair_over(four[3], four[2]),
                           cs_over_pair_over(four[1], four[0]));
}

/* Node `place` of tier 0 has changed: joins those above it again, except for the last. */
static inline void renew_above(cs_over_tree *tree, size_t place) {
  for (int tier = 1; tier < tree->top; tier++) {
    place /= CS_OVER_FOUR;
    tree->tiers[tier][place] = join(&tree->tiers[tier - 1][CS_OVER_FOUR * place]);
  }
}

/* Word i of the set has become `word`. */
static inline celspan_status renew_word(cs_over_tree *tree, size_t i, uint64_t word) {
  uint64_t changed = tree->words[i] ^ word;
  if (!tree->quads[i])
    CS_TRY(cs_over_quads_create(tree->context, tree->stack, i, &tree->quads[i]));
  tree->words[i] = word;
  while (changed != 0) {
    unsigned quad = (unsigned)__builtin_ctzll(changed) / CS_OVER_FOUR;
    unsigned choice = (unsigned)(word >> CS_OVER_FOUR * quad) % CS_OVER_CHOICES;
    changed &= ~((uint64_t)(CS_OVER_CHOICES - 1) << CS_OVER_FOUR * quad);
    size_t place = CS_OVER_QUADS * i + quad;
    tree->tiers[0][place] = tree->quads[i][CS_OVER_CHOICES * quad + choice];
    renew_above(tree, place);
  }
  return CELSPAN_OK;
}

#define BATCH 8 /* words compared at a time */

/* Which of eight words differ, as bits. The set has just been written word by word: whoever reads
 * two at once waits until both have left the processor's store buffer. */
static inline unsigned compare_words(const uint64_t *a, const uint64_t *b) {
  unsigned differ = 0;
  for (unsigned i = 0; i < BATCH; i++)
    differ |= (unsigned)(a[i] != b[i]) << i;
  return differ;
}

/* Brings the tree to a set. */
static celspan_status renew(cs_over_tree *tree, const uint64_t *set) {
  size_t first = 0;
  for (; first + BATCH <= tree->word_count; first += BATCH) {
    unsigned differ = compare_words(tree->words + first, set + first);
    for (; differ != 0; differ &= differ - 1) {
      size_t i = first + (size_t)__builtin_ctz(differ);
      CS_TRY(renew_word(tree, i, set[i]));
    }
  }
  for (; first < tree->word_count; first++)
    if (tree->words[first] != set[first])
      CS_TRY(renew_word(tree, first, set[first]));
  *tree->tiers[tree->top] = join(tree->tiers[tree->top - 1]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

/* The light as far as it comes, where the layers together let nothing through. It ends in the
 * rearmost quad at the latest: there is nothing behind that one. */
static cs_over_pair go_down(const cs_over_tree *tree) {
  cs_over_pair light = cs_over_pair_clear;
  size_t place = 0;
  for (int tier = tree->top; tier > 0; tier--) {
    const cs_over_pair *nodes = tree->tiers[tier - 1];
    for (place = CS_OVER_FOUR * place + CS_OVER_FOUR - 1; place % CS_OVER_FOUR > 0; place--) {
      cs_over_pair all = cs_over_pair_over(light, nodes[place]);
      if (cs_over_is_opaque(all.t))
        break;
      light = all;
    }
  }
  size_t word = place / CS_OVER_QUADS, quad = place % CS_OVER_QUADS;
  uint64_t four = (uint64_t)(CS_OVER_CHOICES - 1) << CS_OVER_FOUR * quad;
  return cs_over_word_layers(tree->stack, light, word, tree->words[word] & four);
}

celspan_status cs_over_tree_light(cs_over_tree *tree, const uint64_t *set, cs_over_pair *out) {
  CS_TRY(renew(tree, set));
  *out = *tree->tiers[tree->top];
  if (cs_over_is_opaque(out->t))
    *out = go_down(tree);
  return CELSPAN_OK;
}
