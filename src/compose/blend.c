#include "compose/blend.h"

#define WIDE(blend, name) CS_WIDE_CHOOSE((blend)->isa, name)

static celspan_status open_level(celspan_context *context, cs_arena *arena, cs_blend *blend) {
  cs_blend_level *level = cs_arena_take(context, arena, sizeof *level);
  if (!level)
    return CELSPAN_NO_MEMORY;
  WIDE(blend, cs_blend_clear)(level, blend->count);
  blend->level = level;
  return CELSPAN_OK;
}

celspan_status cs_blend_begin(celspan_context *context, cs_arena *arena, const cs_stack *stack,
                              cs_isa isa, int32_t count, cs_blend *out) {
  out->stack = stack;
  out->isa = isa;
  out->count = count;
  out->depth = 0;
  out->group = CS_STACK_NONE;
  out->light = 0;
  out->keep = 1;
  return open_level(context, arena, out);
}

static void leave_group(cs_blend *blend) {
  const cs_group *group = &blend->stack->groups[blend->group];
  cs_blend_level *inner = blend->level;
  blend->level = blend->outer[--blend->depth];
  WIDE(blend, cs_blend_add_group)(blend->level, blend->count, group->fade, inner);
  blend->group = group->parent;
}

static celspan_status enter_group(celspan_context *context, cs_arena *arena, cs_blend *blend,
                                  uint32_t group) {
  const cs_group *inner = &blend->stack->groups[group];
  if (inner->parent != blend->group) /* at most CS_SCENE_DEPTH + 1 levels */
    CS_TRY(enter_group(context, arena, blend, inner->parent));
  blend->outer[blend->depth++] = blend->level;
  blend->group = group;
  return open_level(context, arena, blend);
}

static void meet_light(cs_blend *blend) {
  const cs_back_light *light = &blend->stack->lights[blend->light++];
  WIDE(blend, cs_blend_add_light)(blend->level, blend->count, (const float *)&light->light);
  blend->keep *= light->keep;
}

celspan_status cs_blend_reach(celspan_context *context, cs_arena *arena, cs_blend *blend,
                              uint32_t leaf) {
  const cs_stack *stack = blend->stack;
  while (blend->group != CS_STACK_NONE && leaf < stack->groups[blend->group].first)
    leave_group(blend);
  while (blend->light < stack->light_count && leaf < stack->lights[blend->light].below)
    meet_light(blend);
  if (stack->leaves[leaf].group != blend->group)
    return enter_group(context, arena, blend, stack->leaves[leaf].group);
  return CELSPAN_OK;
}

void cs_blend_flat(cs_blend *blend, const cs_leaf *leaf) {
  WIDE(blend, cs_blend_add_flat)
  (blend->level, blend->count, (const float *)&leaf->s, (const float *)&leaf->t);
}

void cs_blend_picture(cs_blend *blend, const cs_leaf *leaf, celspan_picture_use use,
                      const float (*rgba)[4]) {
  WIDE(blend, cs_blend_add_picture)
  (blend->level, blend->count, (const float *)&leaf->front, leaf->fade, use == CELSPAN_PICTURE_GEL,
   rgba);
}

void cs_blend_paints(cs_blend *blend, const cs_leaf *leaf, const float (*s)[4],
                     const float (*t)[4]) {
  WIDE(blend, cs_blend_add_paints)
  (blend->level, blend->count, (const float *)&leaf->front, leaf->fade, s, t);
}

celspan_status cs_blend_leaf(celspan_context *context, cs_arena *arena, cs_blend *blend,
                             uint32_t leaf, const float (*s)[4], const float (*t)[4]) {
  const cs_leaf *at = &blend->stack->leaves[leaf];
  CS_TRY(cs_blend_reach(context, arena, blend, leaf));
  if (at->kind == CS_LEAF_FLAT)
    cs_blend_flat(blend, at);
  else
    cs_blend_paints(blend, at, s, t);
  return CELSPAN_OK;
}

cs_blend_part cs_blend_bare(cs_isa isa, bool is_first, const float (*rgba)[4], cs_blend_part part,
                            float (*folded)[4]) {
  return CS_WIDE_CHOOSE(isa, cs_blend_fold_bare)(is_first, rgba, part, folded);
}

/* Elsewhere nothing of it is seen. */
static const cs_back_light *finish_layers(const cs_stack *stack, cs_blend_layers *layers) {
  static const cs_back_light none = {.keep = 1};
  const cs_blend_part *part = &layers->part;
  memset(layers->rgba, 0, (size_t)part->first * sizeof *layers->rgba);
  memset(layers->rgba + part->end, 0, (size_t)(layers->count - part->end) * sizeof *layers->rgba);
  return stack->light_count > 0 ? stack->lights : &none;
}

void cs_blend_bare_end(cs_isa isa, const cs_stack *stack, cs_blend_layers *layers,
                       float (*rgba)[4]) {
  const cs_back_light *behind = finish_layers(stack, layers);
  CS_WIDE_CHOOSE(isa, cs_blend_end_bare)
  (behind, layers->is_first, (const float(*)[4])layers->rgba, layers->count,
   (const float(*)[4])layers->folded, rgba);
}

void cs_blend_bare_codes(cs_isa isa, const cs_stack *stack, cs_blend_layers *layers,
                         unsigned char *codes) {
  const cs_back_light *behind = finish_layers(stack, layers);
  CS_WIDE_CHOOSE(isa, cs_blend_code_bare)
  (behind, layers->is_first, (const float(*)[4])layers->rgba, layers->count,
   (const float(*)[4])layers->folded, codes);
}

void cs_blend_end(cs_blend *blend, float (*rgba)[4]) {
  while (blend->group != CS_STACK_NONE)
    leave_group(blend);
  while (blend->light < blend->stack->light_count)
    meet_light(blend);
  WIDE(blend, cs_blend_to_rgba)(blend->level, blend->count, blend->keep, rgba);
}
