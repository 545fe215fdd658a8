#include "compose/tree_certain.h"

/* One more operand for an operator. `both` and `any` are of the operands so far. */
typedef struct operands {
  cs_cull_presence first, both, any, others; /* others: any but the first */
  uint64_t known, odd;                       /* where all are known; where their number is odd */
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
  case CELSPAN_UNION:
    return o->any;
  case CELSPAN_INTERSECTION:
  case CELSPAN_CLIP:
    return o->both;
  case CELSPAN_DIFFERENCE:
    return (cs_cull_presence){o->first.certain & ~o->others.possible,
                              o->first.possible & ~o->others.certain};
  case CELSPAN_XOR:
    return (cs_cull_presence){o->known & o->odd, (~o->known | o->odd) & o->any.possible};
  }
  return (cs_cull_presence){0, 0};
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

static cs_tree_certain_result resolve_step(const tiles *t, const cs_step *step,
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
  cs_cull_presence presence = combine(step->kind == CS_STEP_FRAME ? CELSPAN_UNION : step->op, &o);
  restrict_layers(t, step->first, step->end, presence.certain);
  if (step->kind != CS_STEP_FRAME && step->op == CELSPAN_CLIP)
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
    if (step->kind == CS_STEP_LAYER) {
      results[depth++] = (cs_tree_certain_result){presence_of(&t, step->first), step->end};
      continue;
    }
    if (step->kind != CS_STEP_LAYERS)
      depth -= step->operands;
    results[depth] = resolve_step(&t, step, &results[depth]);
    depth++;
  }
}
