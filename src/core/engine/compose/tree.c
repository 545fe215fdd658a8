#include "engine/compose/tree.h"

#define TOGETHER 16 /* neighbouring trees that are skipped at once where none is present */

/* The bits of word `word` that lie in [first, end). */
static uint64_t range_mask(uint32_t word, uint32_t first, uint32_t end) {
  uint32_t base = word * 64;
  uint64_t mask = ~(uint64_t)0;
  if (first > base)
    mask &= ~(uint64_t)0 << (first - base);
  if (end < base + 64)
    mask &= ((uint64_t)1 << (end - base)) - 1;
  return mask;
}

static uint32_t count_range(const uint64_t *set, uint32_t first, uint32_t end) {
  uint32_t count = 0;
  for (uint32_t word = first / 64; word * 64 < end; word++)
    count += (uint32_t)__builtin_popcountll(set[word] & range_mask(word, first, end));
  return count;
}

static bool any_in_range(const uint64_t *set, uint32_t first, uint32_t end) {
  for (uint32_t word = first / 64; word * 64 < end; word++)
    if (set[word] & range_mask(word, first, end))
      return true;
  return false;
}

static void clear_range(uint64_t *set, uint32_t first, uint32_t end) {
  for (uint32_t word = first / 64; word * 64 < end; word++)
    set[word] &= ~range_mask(word, first, end);
}

static bool has_bit(const uint64_t *set, uint32_t layer) {
  return set[layer / 64] >> (layer % 64) & 1;
}

/* Whether the operator is present, given how many operands are present and whether the first one
 * is. */
static bool is_operator_present(celspan_operator op, uint32_t operands, uint32_t present,
                                bool first) {
  if (present == 0)
    return false;
  switch (op) {
  case CELSPAN_OPERATOR_UNION:
    return true;
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return present == operands;
  case CELSPAN_OPERATOR_DIFFERENCE:
    return first && present == 1;
  case CELSPAN_OPERATOR_XOR:
    return present % 2 == 1;
  }
  return first; /* a matte */
}

/* Clears the layers that the operator does not paint: all layers where it is absent; the layers of
 * the shape where a clip is present. first_end: where the layers of the first operand end. */
static void clear_hidden(const cs_step *step, uint32_t first_end, bool is_present, uint64_t *set) {
  if (!is_present)
    clear_range(set, step->first, step->end);
  else if (step->op == CELSPAN_OPERATOR_CLIP)
    clear_range(set, first_end, step->end);
}

/* A composition inside another is cut at its frame; the results of its trees are not used
 * outside. */
static cs_tree_result resolve_frame(const cs_step *step, uint64_t *set) {
  bool is_present = has_bit(set, step->first);
  if (!is_present)
    clear_range(set, step->first, step->end);
  return (cs_tree_result){step->first, step->end, is_present};
}

static cs_tree_result resolve_step(const cs_step *step, uint64_t *set,
                                   const cs_tree_result *operands) {
  uint32_t present = 0, first_end = step->first + 1;
  bool first = false;
  if (step->operands == 0)
    return (cs_tree_result){step->first, step->end, false};
  if (step->kind == CS_STEP_OPERATOR) {
    for (uint32_t i = 0; i < step->operands; i++)
      present += operands[i].is_present;
    first = operands[0].is_present;
    first_end = operands[0].end;
  } else {
    present = count_range(set, step->first, step->end);
    first = has_bit(set, step->first);
  }
  bool is_present = is_operator_present(step->op, step->operands, present, first);
  clear_hidden(step, first_end, is_present, set);
  return (cs_tree_result){step->first, step->end, is_present};
}

/* The number of steps to skip after a guard: none, or all steps that it guards, of which the last
 * clears its layers and is absent. */
static uint32_t skip_guarded(const cs_step *guard, uint64_t *set, cs_tree_result *result) {
  if (any_in_range(set, guard->first, guard->end))
    return 0;
  const cs_step *last = guard + guard->operands;
  clear_range(set, last->first, last->end);
  *result = (cs_tree_result){last->first, last->end, false};
  return guard->operands;
}

static void resolve_tree(const cs_stack *stack, const cs_tree *tree, uint64_t *set,
                         cs_tree_result *results) {
  size_t depth = 0;
  for (uint32_t i = 0; i < tree->step_count; i++) {
    const cs_step *step = &stack->steps[tree->step + i];
    if (step->kind == CS_STEP_GUARD) {
      uint32_t skipped = skip_guarded(step, set, &results[depth]);
      depth += skipped > 0;
      i += skipped;
      continue;
    }
    if (step->kind == CS_STEP_LAYER) {
      results[depth++] = (cs_tree_result){step->first, step->end, has_bit(set, step->first)};
      continue;
    }
    if (step->kind == CS_STEP_OPERATOR || step->kind == CS_STEP_FRAME)
      depth -= step->operands;
    results[depth] = step->kind == CS_STEP_FRAME ? resolve_frame(step, set)
                                                 : resolve_step(step, set, &results[depth]);
    depth++;
  }
}

void cs_tree_resolve(const cs_stack *stack, uint64_t *set, cs_tree_result *results) {
  const cs_tree *trees = stack->trees;
  for (size_t from = 0, end; from < stack->tree_count; from = end) {
    end = stack->tree_count - from < TOGETHER ? stack->tree_count : from + TOGETHER;
    if (!any_in_range(set, trees[from].first, trees[end - 1].end))
      continue;
    for (size_t i = from; i < end; i++)
      if (any_in_range(set, trees[i].first, trees[i].end))
        resolve_tree(stack, &trees[i], set, results);
  }
}

/* ---------------------------------------------------------------- over tiles */

/* One more operand for an operator. `both` and `any` combine the operands so far. */
typedef struct operands {
  cs_cull_presence first, both, any, others; /* others: any operand except the first */
  /* known: where all operands are known; odd: where an odd number is present */
  uint64_t known, odd;
  uint32_t count;
} operands;

static const operands no_operands = {
    {0, 0}, {~(uint64_t)0, ~(uint64_t)0}, {0, 0}, {0, 0}, ~(uint64_t)0, 0, 0};

static void join(cs_cull_presence *any, cs_cull_presence p) {
  any->certain |= p.certain;
  any->possible |= p.possible;
}

static void add_operand(operands *o, cs_cull_presence p) {
  if (o->count++ == 0)
    o->first = p;
  else
    join(&o->others, p);
  join(&o->any, p);
  o->both.certain &= p.certain;
  o->both.possible &= p.possible;
  o->known &= ~(p.certain ^ p.possible);
  o->odd ^= p.certain;
}

static cs_cull_presence combine(celspan_operator op, const operands *o) {
  if (o->count == 0)
    return (cs_cull_presence){0, 0};
  switch (op) {
  case CELSPAN_OPERATOR_UNION:
    return o->any;
  case CELSPAN_OPERATOR_INTERSECTION:
  case CELSPAN_OPERATOR_CLIP:
    return o->both;
  case CELSPAN_OPERATOR_DIFFERENCE:
    return (cs_cull_presence){o->first.certain & ~o->others.possible,
                              o->first.possible & ~o->others.certain};
  case CELSPAN_OPERATOR_XOR:
    return (cs_cull_presence){o->known & o->odd, (~o->known | o->odd) & o->any.possible};
  }
  return o->first; /* a matte */
}

/* The layers of one tree. */
typedef struct tiles {
  uint32_t first;
  const cs_cull_presence *presences;
  uint64_t *painted;
} tiles;

static cs_cull_presence presence_of(const tiles *t, uint32_t layer) {
  return t->presences[layer - t->first];
}

static void restrict_layers(const tiles *t, uint32_t first, uint32_t end, uint64_t where) {
  for (uint32_t layer = first; layer < end; layer++)
    t->painted[layer - t->first] &= where;
}

static cs_tree_certain_result resolve_over_tiles(const tiles *t, const cs_step *step,
                                                 const cs_tree_certain_result *below) {
  operands o = no_operands;
  uint32_t first_end = step->first + 1;
  if (step->kind == CS_STEP_FRAME) {
    add_operand(&o, presence_of(t, step->first));
  } else if (step->kind == CS_STEP_OPERATOR) {
    for (uint32_t i = 0; i < step->operands; i++)
      add_operand(&o, below[i].presence);
    first_end = step->operands > 0 ? below[0].end : first_end;
  } else {
    for (uint32_t layer = step->first; layer < step->end; layer++)
      add_operand(&o, presence_of(t, layer));
  }
  cs_cull_presence presence =
      combine(step->kind == CS_STEP_FRAME ? CELSPAN_OPERATOR_UNION : step->op, &o);
  restrict_layers(t, step->first, step->end, presence.certain);
  if (step->kind != CS_STEP_FRAME && step->op == CELSPAN_OPERATOR_CLIP)
    restrict_layers(t, first_end, step->end, 0);
  return (cs_tree_certain_result){presence, step->end};
}

void cs_tree_certain(const cs_stack *stack, const cs_tree *tree, const cs_cull_presence *presences,
                     cs_tree_certain_result *results, uint64_t *painted) {
  const tiles t = {tree->first, presences, painted};
  size_t depth = 0;
  for (uint32_t layer = tree->first; layer < tree->end; layer++)
    painted[layer - tree->first] = presence_of(&t, layer).certain;
  for (uint32_t i = 0; i < tree->step_count; i++) {
    const cs_step *step = &stack->steps[tree->step + i];
    if (step->kind == CS_STEP_GUARD)
      continue;
    if (step->kind == CS_STEP_LAYER) {
      results[depth++] = (cs_tree_certain_result){presence_of(&t, step->first), step->end};
      continue;
    }
    if (step->kind != CS_STEP_LAYERS)
      depth -= step->operands;
    results[depth] = resolve_over_tiles(&t, step, &results[depth]);
    depth++;
  }
}
