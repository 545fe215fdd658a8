#include "compose/over_table.h"

#define FOUR 4              /* leaves of a part */
#define PARTS 16            /* of a word */
#define CHOICES (1 << FOUR) /* of the leaves of a part */

bool cs_over_table_suits(const cs_stack *stack) {
  for (size_t i = 0; i < stack->layer_count; i++)
    if (stack->layers[i].kind != CS_LAYER_FLAT)
      return false;
  for (size_t i = 0; i < stack->light_count; i++)
    if (stack->lights[i].below > 0)
      return false;
  return stack->group_count == 0;
}

celspan_status cs_over_table_init(cs_over_table *folds, celspan_context *context,
                                  const cs_stack *stack) {
  *folds = (cs_over_table){.context = context, .stack = stack};
  size_t count = cs_stack_words(stack);
  folds->words = cs_mem_array(context->memory, count, sizeof *folds->words);
  if (count > 0 && !folds->words)
    return cs_fail_memory(context);
  folds->count = count;
  for (size_t i = 0; i < count; i++)
    folds->words[i].all = cs_over_pair_clear;
  return CELSPAN_OK;
}

void cs_over_table_finish(cs_over_table *folds) {
  if (!folds->context)
    return;
  cs_memory *memory = folds->context->memory;
  for (size_t i = 0; folds->words && i < folds->count; i++)
    cs_mem_free(memory, folds->words[i].parts, PARTS * CHOICES * sizeof(cs_over_pair));
  cs_mem_free(memory, folds->words, folds->count * sizeof *folds->words);
  *folds = (cs_over_table){0};
}

/* ---------------------------------------------------------------- words */

static inline cs_over_pair glimpse_layer(const cs_over_table *folds, size_t layer) {
  if (layer >= folds->stack->layer_count)
    return cs_over_pair_clear;
  return (cs_over_pair){folds->stack->layers[layer].s, folds->stack->layers[layer].t};
}

static void make_part(const cs_over_table *folds, size_t layer, cs_over_pair *part) {
  cs_over_pair halves[2][FOUR]; /* what the lower two leaves may give, and the upper two */
  for (size_t half = 0; half < 2; half++) {
    cs_over_pair *h = halves[half];
    h[0] = cs_over_pair_clear;
    h[1] = glimpse_layer(folds, layer + 2 * half);
    h[2] = glimpse_layer(folds, layer + 2 * half + 1);
    h[3] = cs_over_pair_over(h[2], h[1]);
  }
  for (size_t choice = 0; choice < CHOICES; choice++)
    part[choice] = cs_over_pair_over(halves[1][choice / FOUR], halves[0][choice % FOUR]);
}

static celspan_status make_parts(cs_over_table *folds, size_t i) {
  cs_over_pair *parts = cs_mem_array(folds->context->memory, PARTS * CHOICES, sizeof *parts);
  if (!parts)
    return cs_fail_memory(folds->context);
  for (size_t part = 0; part < PARTS; part++)
    make_part(folds, 64 * i + FOUR * part, parts + CHOICES * part);
  folds->words[i].parts = parts;
  return CELSPAN_OK;
}

/* Sixteen leaves of a word, the first of which is the lowest bit. */
static inline cs_over_pair fold_quarter(const cs_over_pair *parts, unsigned word) {
  const cs_over_pair *high = &parts[2 * CHOICES];
  return cs_over_pair_over(
      cs_over_pair_over(high[CHOICES + (word >> 12 & 15)], high[word >> 8 & 15]),
      cs_over_pair_over(parts[CHOICES + (word >> 4 & 15)], parts[word & 15]));
}

static inline cs_over_pair fold_quarters(const cs_over_pair *parts, uint64_t word) {
  const size_t quarter = FOUR * CHOICES;
  return cs_over_pair_over(
      cs_over_pair_over(fold_quarter(parts + 3 * quarter, (unsigned)(word >> 48)),
                        fold_quarter(parts + 2 * quarter, (unsigned)(word >> 32))),
      cs_over_pair_over(fold_quarter(parts + quarter, (unsigned)(word >> 16)),
                        fold_quarter(parts, (unsigned)word)));
}

/* At most two leaves, as in most words where shapes are small or few are seen, need no parts. */
static cs_over_pair fold_few(const cs_over_table *folds, size_t i, uint64_t word) {
  if (word == 0)
    return cs_over_pair_clear;
  size_t front = 64 * i + 63 - (size_t)__builtin_clzll(word);
  size_t back = 64 * i + (size_t)__builtin_ctzll(word);
  cs_over_pair glimpse = glimpse_layer(folds, front);
  return front == back ? glimpse : cs_over_pair_over(glimpse, glimpse_layer(folds, back));
}

/* Word i of the set has become `word`. */
static celspan_status fold_word(cs_over_table *folds, size_t i, uint64_t word) {
  cs_over_word *known = &folds->words[i];
  uint64_t more = word & (word - (word != 0)); /* without one leaf */
  known->word = word;
  if ((more & (more - (more != 0))) == 0) {
    known->all = fold_few(folds, i, word);
    return CELSPAN_OK;
  }
  if (!known->parts)
    CS_TRY(make_parts(folds, i));
  known->all = fold_quarters(known->parts, word);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

static inline bool is_opaque(cs_v4 t) { return !cs_v4_any_above(t, cs_v4_all(CS_PAINT_OPAQUE)); }

/* The word in which the light ends, leaf by leaf. */
static cs_over_pair fold_last(const cs_over_table *folds, cs_over_pair light, size_t i) {
  for (uint64_t word = folds->words[i].word; word != 0 && !is_opaque(light.t);) {
    int highest = 63 - __builtin_clzll(word);
    word ^= (uint64_t)1 << highest;
    light = cs_over_pair_over(light, glimpse_layer(folds, 64 * i + (size_t)highest));
  }
  return light;
}

celspan_status cs_over_table_light(cs_over_table *folds, const uint64_t *set, const uint8_t *filled,
                                   cs_over_pair *out) {
  cs_over_pair light = cs_over_pair_clear;
  uint32_t end = (uint32_t)(folds->count + 7) / 8 * 8;
  for (; (end = cs_over_table_skip(filled, end)) > 0; end -= 8)
    for (size_t i = end; i-- > end - 8;) {
      if (!filled[i])
        continue;
      if (folds->words[i].word != set[i])
        CS_TRY(fold_word(folds, i, set[i]));
      cs_over_pair all = cs_over_pair_over(light, folds->words[i].all);
      if (is_opaque(all.t)) {
        *out = fold_last(folds, light, i);
        return CELSPAN_OK;
      }
      light = all;
    }
  *out = light;
  return CELSPAN_OK;
}
