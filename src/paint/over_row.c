#include "paint/over_row.h"

#define WIDE(blend, name) CS_WIDE_CHOOSE((blend)->isa, name)

static celspan_status open_level(celspan_context *context, cs_arena *arena, cs_over_row *blend) {
  cs_over_row_level *level = cs_arena_take(context, arena, sizeof *level);
  if (!level)
    return CELSPAN_NO_MEMORY;
  WIDE(blend, cs_over_row_clear)(level, blend->count);
  blend->level = level;
  return CELSPAN_OK;
}

celspan_status cs_over_row_begin(celspan_context *context, cs_arena *arena, const cs_stack *stack,
                                 cs_isa isa, int32_t count, cs_over_row *out) {
  out->stack = stack;
  out->isa = isa;
  out->count = count;
  out->depth = 0;
  out->group = CS_STACK_NONE;
  out->light = 0;
  out->keep = 1;
  return open_level(context, arena, out);
}

static void leave_group(cs_over_row *blend) {
  const cs_group *group = &blend->stack->groups[blend->group];
  cs_over_row_level *inner = blend->level;
  blend->level = blend->outer[--blend->depth];
  WIDE(blend, cs_over_row_add_group)(blend->level, blend->count, group->fade, inner);
  blend->group = group->parent;
}

static celspan_status enter_group(celspan_context *context, cs_arena *arena, cs_over_row *blend,
                                  uint32_t group) {
  const cs_group *inner = &blend->stack->groups[group];
  if (inner->parent != blend->group) /* at most CS_SCENE_DEPTH + 1 levels */
    CS_TRY(enter_group(context, arena, blend, inner->parent));
  blend->outer[blend->depth++] = blend->level;
  blend->group = group;
  return open_level(context, arena, blend);
}

static void meet_light(cs_over_row *blend) {
  const cs_back_light *light = &blend->stack->lights[blend->light++];
  WIDE(blend, cs_over_row_add_light)(blend->level, blend->count, (const float *)&light->light);
  blend->keep *= light->keep;
}

celspan_status cs_over_row_reach(celspan_context *context, cs_arena *arena, cs_over_row *blend,
                                 uint32_t layer) {
  const cs_stack *stack = blend->stack;
  while (blend->group != CS_STACK_NONE && layer < stack->groups[blend->group].first)
    leave_group(blend);
  while (blend->light < stack->light_count && layer < stack->lights[blend->light].below)
    meet_light(blend);
  if (stack->layers[layer].group != blend->group)
    return enter_group(context, arena, blend, stack->layers[layer].group);
  return CELSPAN_OK;
}

void cs_over_row_flat(cs_over_row *blend, const cs_layer *layer) {
  WIDE(blend, cs_over_row_add_flat)
  (blend->level, blend->count, (const float *)&layer->s, (const float *)&layer->t);
}

void cs_over_row_picture(cs_over_row *blend, const cs_layer *layer, celspan_picture_use use,
                         const float (*rgba)[4]) {
  WIDE(blend, cs_over_row_add_picture)
  (blend->level, blend->count, (const float *)&layer->front, layer->fade,
   use == CELSPAN_PICTURE_GEL, rgba);
}

void cs_over_row_paints(cs_over_row *blend, const cs_layer *layer, const float (*s)[4],
                        const float (*t)[4]) {
  WIDE(blend, cs_over_row_add_paints)
  (blend->level, blend->count, (const float *)&layer->front, layer->fade, s, t);
}

celspan_status cs_over_row_layer(celspan_context *context, cs_arena *arena, cs_over_row *blend,
                                 uint32_t layer, const float (*s)[4], const float (*t)[4]) {
  const cs_layer *at = &blend->stack->layers[layer];
  CS_TRY(cs_over_row_reach(context, arena, blend, layer));
  if (at->kind == CS_LAYER_FLAT)
    cs_over_row_flat(blend, at);
  else
    cs_over_row_paints(blend, at, s, t);
  return CELSPAN_OK;
}

cs_over_row_part cs_over_row_bare(cs_isa isa, bool is_first, const float (*rgba)[4],
                                  cs_over_row_part part, float (*folded)[4]) {
  return CS_WIDE_CHOOSE(isa, cs_over_row_fold_bare)(is_first, rgba, part, folded);
}

/* Elsewhere nothing of it is seen. */
static const cs_back_light *finish_layers(const cs_stack *stack, cs_over_row_layers *layers) {
  static const cs_back_light none = {.keep = 1};
  const cs_over_row_part *part = &layers->part;
  memset(layers->rgba, 0, (size_t)part->first * sizeof *layers->rgba);
  memset(layers->rgba + part->end, 0, (size_t)(layers->count - part->end) * sizeof *layers->rgba);
  return stack->light_count > 0 ? stack->lights : &none;
}

void cs_over_row_bare_end(cs_isa isa, const cs_stack *stack, cs_over_row_layers *layers,
                          float (*rgba)[4]) {
  const cs_back_light *behind = finish_layers(stack, layers);
  CS_WIDE_CHOOSE(isa, cs_over_row_end_bare)
  (behind, layers->is_first, (const float(*)[4])layers->rgba, layers->count,
   (const float(*)[4])layers->folded, rgba);
}

void cs_over_row_bare_codes(cs_isa isa, const cs_stack *stack, cs_over_row_layers *layers,
                            unsigned char *codes) {
  const cs_back_light *behind = finish_layers(stack, layers);
  CS_WIDE_CHOOSE(isa, cs_over_row_code_bare)
  (behind, layers->is_first, (const float(*)[4])layers->rgba, layers->count,
   (const float(*)[4])layers->folded, codes);
}

void cs_over_row_end(cs_over_row *blend, float (*rgba)[4]) {
  while (blend->group != CS_STACK_NONE)
    leave_group(blend);
  while (blend->light < blend->stack->light_count)
    meet_light(blend);
  WIDE(blend, cs_over_row_to_rgba)(blend->level, blend->count, blend->keep, rgba);
}
