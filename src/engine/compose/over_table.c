#include "engine/compose/over_table.h"

#include "engine/compose/set.h"

bool cs_over_table_suits(const cs_stack *stack) {
  for (size_t i = 0; i < stack->layer_count; i++)
    if (stack->layers[i].kind != CS_LAYER_FLAT)
      return false;
  for (size_t i = 0; i < stack->light_count; i++)
    if (stack->lights[i].below > 0)
      return false;
  return stack->group_count == 0;
}

celspan_status cs_over_table_init(cs_over_table *table, celspan_context *context,
                                  const cs_stack *stack) {
  *table = (cs_over_table){.context = context, .stack = stack};
  size_t count = cs_stack_words(stack);
  table->words = cs_mem_array(context->memory, count, sizeof *table->words);
  if (count > 0 && !table->words)
    return cs_fail_memory(context);
  table->count = count;
  for (size_t i = 0; i < count; i++)
    table->words[i].all = cs_over_pair_clear;
  return CELSPAN_OK;
}

void cs_over_table_finish(cs_over_table *table) {
  if (!table->context)
    return;
  cs_memory *memory = table->context->memory;
  for (size_t i = 0; table->words && i < table->count; i++)
    cs_over_quads_free(table->words[i].quads, memory);
  cs_mem_free(memory, table->words, table->count * sizeof *table->words);
  *table = (cs_over_table){0};
}

/* ---------------------------------------------------------------- words */

/* Sixteen layers of a word, the first of which is the lowest bit. */
static inline cs_over_pair fold_quarter(const cs_over_pair *quads, unsigned word) {
  const cs_over_pair *high = &quads[2 * CS_OVER_CHOICES];
  return cs_over_pair_over(
      cs_over_pair_over(high[CS_OVER_CHOICES + (word >> 12 & 15)], high[word >> 8 & 15]),
      cs_over_pair_over(quads[CS_OVER_CHOICES + (word >> 4 & 15)], quads[word & 15]));
}

static inline cs_over_pair fold_quarters(const cs_over_pair *quads, uint64_t word) {
  const size_t quarter = CS_OVER_FOUR * CS_OVER_CHOICES;
  return cs_over_pair_over(
      cs_over_pair_over(fold_quarter(quads + 3 * quarter, (unsigned)(word >> 48)),
                        fold_quarter(quads + 2 * quarter, (unsigned)(word >> 32))),
      cs_over_pair_over(fold_quarter(quads + quarter, (unsigned)(word >> 16)),
                        fold_quarter(quads, (unsigned)word)));
}

/* At most two layers need no quads: so it is in most words where shapes are small or few. */
static cs_over_pair fold_few(const cs_over_table *table, size_t i, uint64_t word) {
  if (word == 0)
    return cs_over_pair_clear;
  size_t front = 64 * i + 63 - (size_t)__builtin_clzll(word);
  size_t back = 64 * i + (size_t)__builtin_ctzll(word);
  cs_over_pair pair = cs_over_layer_pair(table->stack, front);
  return front == back ? pair : cs_over_pair_over(pair, cs_over_layer_pair(table->stack, back));
}

/* Word i of the set has become `word`. */
static celspan_status fold_word(cs_over_table *table, size_t i, uint64_t word) {
  cs_over_word *known = &table->words[i];
  uint64_t more = word & (word - (word != 0)); /* without the lowest layer */
  known->word = word;
  if ((more & (more - (more != 0))) == 0) {
    known->all = fold_few(table, i, word);
    return CELSPAN_OK;
  }
  if (!known->quads)
    CS_TRY(cs_over_quads_create(table->context, table->stack, i, &known->quads));
  known->all = fold_quarters(known->quads, word);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

celspan_status cs_over_table_light(cs_over_table *table, const uint64_t *set, const uint8_t *filled,
                                   cs_over_pair *out) {
  cs_over_pair light = cs_over_pair_clear;
  uint32_t end = (uint32_t)(table->count + 7) / 8 * 8;
  for (; (end = cs_set_skip(filled, end)) > 0; end -= 8)
    for (size_t i = end; i-- > end - 8;) {
      if (!filled[i])
        continue;
      if (table->words[i].word != set[i])
        CS_TRY(fold_word(table, i, set[i]));
      cs_over_pair all = cs_over_pair_over(light, table->words[i].all);
      if (cs_over_is_opaque(all.t)) {
        *out = cs_over_word_layers(table->stack, light, i, set[i]);
        return CELSPAN_OK;
      }
      light = all;
    }
  *out = light;
  return CELSPAN_OK;
}
