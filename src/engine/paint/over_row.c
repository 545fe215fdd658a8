#include "engine/paint/over_row.h"

#define WIDE(over, name) CS_WIDE_CHOOSE((over)->isa, name)

static celspan_status open_state(cs_over_row *over) {
  cs_over_row_state *state = cs_arena_take(over->context, over->arena, sizeof *state);
  if (!state)
    return CELSPAN_NO_MEMORY;
  WIDE(over, cs_over_row_clear)(state, over->count);
  over->state = state;
  return CELSPAN_OK;
}

celspan_status cs_over_row_begin(celspan_context *context, cs_arena *arena, const cs_stack *stack,
                                 cs_isa isa, int32_t count, cs_over_row *out) {
  out->context = context;
  out->arena = arena;
  out->stack = stack;
  out->isa = isa;
  out->count = count;
  out->depth = 0;
  out->group = CS_STACK_NONE;
  out->light = 0;
  out->keep = 1;
  return open_state(out);
}

static void leave_group(cs_over_row *over) {
  const cs_group *group = &over->stack->groups[over->group];
  cs_over_row_state *inner = over->state;
  if (group->has_light)
    WIDE(over, cs_over_row_light_group)
  (inner, over->count, (const float(*)[4])over->fronts[over->depth]);
  over->state = over->outer[--over->depth];
  WIDE(over, cs_over_row_add_group)(over->state, over->count, group->fade, inner);
  over->group = group->parent;
}

static celspan_status enter_group(cs_over_row *over, uint32_t group) {
  const cs_group *inner = &over->stack->groups[group];
  if (inner->parent != over->group) /* at most CS_STACK_GROUPS states */
    CS_TRY(enter_group(over, inner->parent));
  over->outer[over->depth++] = over->state;
  over->group = group;
  return open_state(over);
}

static void meet_light(cs_over_row *over) {
  const cs_back_light *light = &over->stack->lights[over->light++];
  WIDE(over, cs_over_row_add_light)(over->state, over->count, (const float *)&light->light);
  over->keep *= light->keep;
}

celspan_status cs_over_row_move(cs_over_row *over, uint32_t layer) {
  const cs_stack *stack = over->stack;
  while (over->group != CS_STACK_NONE && layer < stack->groups[over->group].first)
    leave_group(over);
  while (over->light < stack->light_count && layer < stack->lights[over->light].below)
    meet_light(over);
  if (stack->layers[layer].group != over->group)
    return enter_group(over, stack->layers[layer].group);
  return CELSPAN_OK;
}

void cs_over_row_add_layer(cs_over_row *over, const cs_layer *layer) {
  WIDE(over, cs_over_row_add_flat)
  (over->state, over->count, (const float *)&layer->s, (const float *)&layer->t);
}

/* A light with a shape: lane 3 of its pigments is not read. */
static celspan_status add_light_shape(cs_over_row *over, const cs_layer *layer,
                                      const float (*s)[4]) {
  const float *gain = (const float *)&layer->front;
  if (layer->role == CS_LAYER_BACK) {
    WIDE(over, cs_over_row_add_back)(over->state, over->count, gain, s);
    return CELSPAN_OK;
  }
  float(*front)[4] = cs_arena_take(over->context, over->arena, CS_OVER_ROW_BATCH * sizeof *front);
  if (!front)
    return CELSPAN_NO_MEMORY;
  WIDE(over, cs_over_row_make_front)(over->count, gain, s, front);
  over->fronts[over->depth] = front;
  return CELSPAN_OK;
}

celspan_status cs_over_row_add_samples(cs_over_row *over, const cs_layer *layer,
                                       celspan_picture_use use, const float (*rgba)[4]) {
  if (layer->role != CS_LAYER_PAINT)
    return add_light_shape(over, layer, rgba);
  WIDE(over, cs_over_row_add_picture)
  (over->state, over->count, (const float *)&layer->front, layer->fade, use == CELSPAN_PICTURE_GEL,
   rgba);
  return CELSPAN_OK;
}

celspan_status cs_over_row_add_paint(cs_over_row *over, const cs_layer *layer, const float (*s)[4],
                                     const float (*t)[4]) {
  if (layer->role != CS_LAYER_PAINT)
    return add_light_shape(over, layer, s);
  WIDE(over, cs_over_row_add_paints)
  (over->state, over->count, (const float *)&layer->front, layer->fade, s, t);
  return CELSPAN_OK;
}

celspan_status cs_over_row_layer(cs_over_row *over, uint32_t layer, const float (*s)[4],
                                 const float (*t)[4]) {
  const cs_layer *at = &over->stack->layers[layer];
  CS_TRY(cs_over_row_move(over, layer));
  if (at->kind != CS_LAYER_FLAT)
    return cs_over_row_add_paint(over, at, s, t);
  cs_over_row_add_layer(over, at);
  return CELSPAN_OK;
}

void cs_over_row_end(cs_over_row *over, float (*rgba)[4]) {
  while (over->group != CS_STACK_NONE)
    leave_group(over);
  while (over->light < over->stack->light_count)
    meet_light(over);
  WIDE(over, cs_over_row_to_rgba)(over->state, over->count, over->keep, rgba);
}
