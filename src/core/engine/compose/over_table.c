#include "engine/compose/over_table.h"

#include <math.h>

#define FOUR CS_OVER_FOUR
#define QUADS 16      /* quads in a word */
#define CHOICES 16    /* choices among the four layers of a quad */
#define LEAST_WORDS 4 /* fewer words are folded quickly without a table */

/* ---------------------------------------------------------------- the choice */

/* The transmission of a layer in its clearest channel; for an opaque layer, the least one that
 * counts. */
static double let_through(const cs_layer *layer) {
  float most = layer->t[0] > layer->t[1] ? layer->t[0] : layer->t[1];
  most = layer->t[2] > most ? layer->t[2] : most;
  return most > CS_PAINT_OPAQUE ? (double)most : (double)CS_PAINT_OPAQUE;
}

/* Nothing shines through after sixteen halvings. Where two layers together halve the light less
 * than once, on the average, more than 32 layers are seen in a place, if as many lie there. */
bool cs_over_table_suits(const cs_stack *stack) {
  size_t words = cs_stack_words(stack), halvings = 0;
  double through = 1;
  if (words < LEAST_WORDS || words > CS_OVER_TABLE_WORDS)
    return false;
  for (size_t i = 0; i < stack->layer_count; i++) {
    int exponent;
    through = frexp(through * let_through(&stack->layers[i]), &exponent);
    halvings += (size_t)-exponent;
  }
  return halvings < stack->layer_count / 2;
}

/* ---------------------------------------------------------------- life */

static inline size_t group_count(size_t nodes) { return (nodes + FOUR - 1) / FOUR; }

/* Every tier except the last is filled up to a multiple of four, with clear nodes. */
static celspan_status make_nodes(cs_over_table *table) {
  size_t starts[CS_OVER_TABLE_TIERS] = {0}, nodes = table->count;
  table->node_count = FOUR * group_count(nodes);
  while (nodes > 1) {
    nodes = group_count(nodes);
    starts[++table->top] = table->node_count;
    table->node_count += FOUR * group_count(nodes);
  }
  CS_TRY(CS_ARRAY_MAKE(table->context, table->nodes, table->node_count));
  for (size_t i = 0; i < table->node_count; i++)
    table->nodes[i] = cs_over_pair_clear;
  for (int tier = 0; tier <= table->top; tier++)
    table->tiers[tier] = table->nodes + starts[tier];
  return CELSPAN_OK;
}

celspan_status cs_over_table_init(cs_over_table *table, celspan_context *context,
                                  const cs_stack *stack) {
  *table = (cs_over_table){.context = context, .stack = stack};
  CS_TRY(CS_ARRAY_MAKE(context, table->words, cs_stack_words(stack)));
  table->count = cs_stack_words(stack);
  for (size_t i = 0; i < table->count; i++)
    for (size_t k = 0; k < FOUR; k++)
      table->words[i].quarters[k] = cs_over_pair_clear;
  return make_nodes(table);
}

void cs_over_table_finish(cs_over_table *table) {
  if (!table->context)
    return;
  cs_memory *memory = table->context->memory;
  for (size_t i = 0; i < table->count; i++)
    cs_mem_free(memory, table->words[i].quads, QUADS * CHOICES * sizeof(cs_over_pair));
  CS_ARRAYS_FREE(memory, table, words, nodes);
  *table = (cs_over_table){0};
}

/* ---------------------------------------------------------------- quads */

/* A flat layer by itself; clear beyond the last layer. */
static inline cs_over_pair layer_pair(const cs_stack *stack, size_t layer) {
  if (layer >= stack->layer_count)
    return cs_over_pair_clear;
  return (cs_over_pair){stack->layers[layer].s, stack->layers[layer].t};
}

static void make_quad(const cs_stack *stack, size_t layer, cs_over_pair *quad) {
  /* all that the lower two layers may give, and all that the upper two may give */
  cs_over_pair halves[2][FOUR];
  for (size_t half = 0; half < 2; half++) {
    cs_over_pair *h = halves[half];
    h[0] = cs_over_pair_clear;
    h[1] = layer_pair(stack, layer + 2 * half);
    h[2] = layer_pair(stack, layer + 2 * half + 1);
    h[3] = cs_over_pair_over(h[2], h[1]);
  }
  for (size_t choice = 0; choice < CHOICES; choice++)
    quad[choice] = cs_over_pair_over(halves[1][choice / FOUR], halves[0][choice % FOUR]);
}

static celspan_status make_quads(const cs_over_table *table, size_t i) {
  cs_over_word *word = &table->words[i];
  CS_TRY(CS_MAKE(table->context, word->quads, QUADS * CHOICES));
  for (size_t quad = 0; quad < QUADS; quad++)
    make_quad(table->stack, 64 * i + FOUR * quad, word->quads + CHOICES * quad);
  return CELSPAN_OK;
}

/* What quad number `quad` of a word gives. */
static inline cs_over_pair quad_of(const cs_over_word *word, size_t quad) {
  return word->quads[CHOICES * quad + (word->word >> FOUR * quad) % CHOICES];
}

/* Adds layers of word i to all light in front of it, one by one from the front, until nothing
 * shines through. */
static cs_over_pair add_layers(const cs_stack *stack, cs_over_pair light, size_t i,
                               uint64_t layers) {
  while (layers != 0 && !cs_over_is_opaque(light.t)) {
    int highest = 63 - __builtin_clzll(layers);
    layers ^= (uint64_t)1 << highest;
    light = cs_over_pair_over(light, layer_pair(stack, 64 * i + (size_t)highest));
  }
  return light;
}

/* ---------------------------------------------------------------- words */

static inline cs_over_pair join(const cs_over_pair *four) {
  return cs_over_pair_over(cs_over_pair_over(four[3], four[2]),
                           cs_over_pair_over(four[1], four[0]));
}

static inline cs_over_pair join_quads(const cs_over_word *word, size_t quarter) {
  cs_over_pair four[FOUR];
  for (size_t k = 0; k < FOUR; k++)
    four[k] = quad_of(word, FOUR * quarter + k);
  return join(four);
}

/* Word i of the set has become `word`. */
static celspan_status join_word(cs_over_table *table, size_t i, uint64_t word) {
  cs_over_word *known = &table->words[i];
  if (!known->quads)
    CS_TRY(make_quads(table, i));
  uint64_t changed = known->word ^ word;
  known->word = word;
  for (size_t quarter = 0; quarter < FOUR; quarter++)
    if ((changed >> 16 * quarter & 0xffff) != 0)
      known->quarters[quarter] = join_quads(known, quarter);
  table->tiers[0][i] = join(known->quarters);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the tree */

#define BATCH 8 /* words compared at a time */

/* A bit for each of eight words: whether it differs from the word of a set. The set has just been
 * written word by word: a read of two words at once waits until both have left the processor's
 * store buffer. */
static inline unsigned compare_words(const cs_over_word *words, const uint64_t *set) {
  unsigned differ = 0;
  for (unsigned i = 0; i < BATCH; i++)
    differ |= (unsigned)(words[i].word != set[i]) << i;
  return differ;
}

/* Word i has become another: joins the nodes above it again, except for the last. */
static inline celspan_status renew_word(cs_over_table *table, size_t i, uint64_t word) {
  CS_TRY(join_word(table, i, word));
  for (int tier = 1; tier < table->top; tier++) {
    i /= FOUR;
    table->tiers[tier][i] = join(&table->tiers[tier - 1][FOUR * i]);
  }
  return CELSPAN_OK;
}

/* Brings the tree to a set. */
static celspan_status renew(cs_over_table *table, const uint64_t *set) {
  size_t first = 0;
  for (; first + BATCH <= table->count; first += BATCH) {
    unsigned differ = compare_words(table->words + first, set + first);
    for (; differ != 0; differ &= differ - 1) {
      size_t i = first + (size_t)__builtin_ctz(differ);
      CS_TRY(renew_word(table, i, set[i]));
    }
  }
  for (; first < table->count; first++)
    if (table->words[first].word != set[first])
      CS_TRY(renew_word(table, first, set[first]));
  *table->tiers[table->top] = join(table->tiers[table->top - 1]);
  return CELSPAN_OK;
}

/* Adds the parts, from the front, as long as light still shines through. Returns the part in which
 * the light ends, at the latest the rearmost of the four. */
static inline size_t add_parts(cs_over_pair *light, const cs_over_pair *four) {
  size_t part = FOUR - 1;
  for (; part > 0; part--) {
    cs_over_pair all = cs_over_pair_over(*light, four[part]);
    if (cs_over_is_opaque(all.t))
      break;
    *light = all;
  }
  return part;
}

/* The light down to the layer where it ends, if the layers together are opaque. */
static cs_over_pair go_down(const cs_over_table *table) {
  cs_over_pair light = cs_over_pair_clear, quads[FOUR];
  size_t i = 0;
  for (int tier = table->top; tier > 0; tier--)
    i = FOUR * i + add_parts(&light, &table->tiers[tier - 1][FOUR * i]);
  const cs_over_word *word = &table->words[i];
  size_t quad = FOUR * add_parts(&light, word->quarters);
  for (size_t k = 0; k < FOUR; k++)
    quads[k] = quad_of(word, quad + k);
  quad += add_parts(&light, quads);
  return add_layers(table->stack, light, i, word->word & (uint64_t)(CHOICES - 1) << FOUR * quad);
}

celspan_status cs_over_table_light(cs_over_table *table, const uint64_t *set, cs_over_pair *out) {
  CS_TRY(renew(table, set));
  *out = *table->tiers[table->top];
  if (cs_over_is_opaque(out->t))
    *out = go_down(table);
  return CELSPAN_OK;
}
