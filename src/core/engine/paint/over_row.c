#include "engine/paint/over_row.h"

#include "engine/paint/shade.h"

#define WIDE(over, name) CS_WIDE_CHOOSE((over)->isa, name)

static celspan_status open_state(cs_over_row *over) {
  cs_over_row_state *state = cs_arena_take(over->context, over->arena, sizeof *state);
  if (!state)
    return CELSPAN_NO_MEMORY;
  over->state = state;
  over->is_clear = true;
  return CELSPAN_OK;
}

static void clear_state(cs_over_row *over) {
  WIDE(over, cs_over_row_clear)(over->state, over->count);
  over->is_clear = false;
}

/* The state, to be added to or read. */
static inline cs_over_row_state *state_of(cs_over_row *over) {
  if (over->is_clear)
    clear_state(over);
  return over->state;
}

/* Whether what is added now is the first. */
static inline bool is_first(cs_over_row *over) {
  bool is_clear = over->is_clear;
  over->is_clear = false;
  return is_clear;
}

static void meet_light(cs_over_row *over) {
  const cs_back_light *light = &over->stack->lights[over->light++];
  WIDE(over, cs_over_row_add_light)
  (state_of(over), over->count, (const float *)&light->light);
  over->keep *= light->keep;
}

/* What a group that has been left contributes to the group around it, not yet faded. */
static void finish_group(cs_over_row *over, const cs_group *group, const cs_over_row_outer *around,
                         cs_over_row_state *inner) {
  if (group->grade || group->converts != CELSPAN_SPACE_AROUND || group->has_front)
    WIDE(over, cs_over_row_develop)(inner, over->count, group, over->keep);
  if (group->has_light)
    WIDE(over, cs_over_row_light_group)(inner, over->count, (const float(*)[4])around->front);
  if (group->kind == CS_GROUP_MATTE)
    WIDE(over, cs_over_row_matte)(around->head, over->count, group, around->head_fade, inner);
  if (group->kind != CS_GROUP_GROUND)
    return;
  celspan_blend mode = (celspan_blend)group->blend;
  WIDE(over, cs_over_row_blend)
  (around->head, over->count, around->head_fade, mode, over->keep, inner);
  over->keep = around->keep * (mode == CELSPAN_BLEND_ADD ? 1 : over->keep);
}

/* Adds a group that has been left to the group around it, or keeps it as the head of the group
 * around it. */
static void add_left(cs_over_row *over, const cs_group *group, cs_over_row_state *inner) {
  if (group->kind == CS_GROUP_HEAD) {
    over->outers[over->depth - 1].head = inner;
    over->outers[over->depth - 1].head_fade = group->fade;
  } else if (over->is_clear && group->fade == 1) {
    over->state = inner;
    over->is_clear = false;
  } else {
    WIDE(over, cs_over_row_add_group)(state_of(over), over->count, group->fade, inner);
  }
}

static void leave_group(cs_over_row *over) {
  const cs_group *group = &over->stack->groups[over->group];
  const cs_over_row_outer *around = &over->outers[--over->depth];
  while (group->is_frame && over->light < over->stack->light_count)
    meet_light(over);
  cs_over_row_state *inner = state_of(over);
  finish_group(over, group, around, inner);
  over->state = around->outer;
  over->is_clear = around->is_clear;
  over->group = around->group;
  add_left(over, group, inner);
}

/* At most CS_STACK_GROUPS states. */
static celspan_status enter(cs_over_row *over, uint32_t group) {
  uint32_t parent = cs_stack_around(over->stack, group, over->group);
  if (parent != over->group)
    CS_TRY(enter(over, parent));
  over->outers[over->depth++] = (cs_over_row_outer){
      .outer = over->state, .is_clear = over->is_clear, .group = over->group, .keep = over->keep};
  over->group = group;
  if (over->stack->groups[group].kind == CS_GROUP_GROUND)
    over->keep = 1;
  return open_state(over);
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
  out->outers = NULL;
  if (stack->group_count > 0) {
    out->outers = cs_arena_take(context, arena, cs_stack_depth(stack) * sizeof *out->outers);
    if (!out->outers)
      return CELSPAN_NO_MEMORY;
  }
  CS_TRY(open_state(out));
  return stack->has_root ? enter(out, 0) : CELSPAN_OK;
}

static celspan_status enter_group(cs_over_row *over, uint32_t group) {
  uint32_t entered = cs_stack_entered(over->stack, group, over->group);
  return entered == over->group ? CELSPAN_OK : enter(over, entered);
}

celspan_status cs_over_row_move_far(cs_over_row *over, uint32_t layer) {
  const cs_stack *stack = over->stack;
  while (over->group != CS_STACK_NONE && layer < stack->groups[over->group].first)
    leave_group(over);
  while (over->light < stack->light_count && layer < stack->lights[over->light].below)
    meet_light(over);
  if (stack->layers[layer].group != over->group)
    return enter_group(over, stack->layers[layer].group);
  return CELSPAN_OK;
}

void cs_over_row_add_lit(cs_over_row *over, const cs_over_pair *lit) {
  WIDE(over, cs_over_row_add_flat)
  (over->state, over->count, is_first(over), (const float *)&lit->e, (const float *)&lit->t);
}

void cs_over_row_add_layer(cs_over_row *over, const cs_layer *layer) {
  const cs_over_pair lit = {layer->s, layer->t};
  cs_over_row_add_lit(over, &lit);
}

/* A light with a shape: lane 3 of its pigments is not read. */
static celspan_status add_light_shape(cs_over_row *over, const cs_layer *layer,
                                      const float (*s)[4]) {
  const float *gain = (const float *)&layer->front;
  if (layer->role == CS_LAYER_BACK) {
    WIDE(over, cs_over_row_add_back)(state_of(over), over->count, gain, s);
    return CELSPAN_OK;
  }
  float(*front)[4] = cs_arena_take(over->context, over->arena, CS_OVER_ROW_BATCH * sizeof *front);
  if (!front)
    return CELSPAN_NO_MEMORY;
  WIDE(over, cs_over_row_make_front)(over->count, gain, s, front);
  over->outers[over->depth - 1].front = front;
  return CELSPAN_OK;
}

celspan_status cs_over_row_add_samples(cs_over_row *over, const cs_layer *layer,
                                       celspan_picture_use use, const float (*rgba)[4]) {
  if (layer->role != CS_LAYER_PAINT)
    return add_light_shape(over, layer, rgba);
  WIDE(over, cs_over_row_add_picture)
  (over->state, over->count, is_first(over), (const float *)&layer->front, layer->fade,
   use == CELSPAN_PICTURE_GEL, rgba);
  return CELSPAN_OK;
}

celspan_status cs_over_row_add_paint(cs_over_row *over, const cs_layer *layer, const float (*s)[4],
                                     const float (*t)[4]) {
  if (layer->role != CS_LAYER_PAINT)
    return add_light_shape(over, layer, s);
  WIDE(over, cs_over_row_add_paints)
  (over->state, over->count, is_first(over), (const float *)&layer->front, layer->fade, s, t);
  return CELSPAN_OK;
}

celspan_status cs_over_row_add_shade(cs_over_row *over, const cs_layer *layer, const double *x,
                                     double y) {
  const cs_shade *shade = &over->stack->shades[layer->index];
  if (layer->role == CS_LAYER_PAINT) {
    const cs_shade_state state = {over->state->e, over->state->t, is_first(over)};
    cs_shade_fold(shade, layer, x, over->count, y, &state);
    return CELSPAN_OK;
  }
  float pigments[CS_OVER_ROW_BATCH][4];
  cs_shade_paints(shade, x, over->count, y, pigments, NULL);
  return add_light_shape(over, layer, (const float(*)[4])pigments);
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
  WIDE(over, cs_over_row_to_rgba)(state_of(over), over->count, over->keep, rgba);
}
