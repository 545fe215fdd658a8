#include "engine/compose/over.h"

/* What a group that has been left contributes to the group around it. */
static cs_over_pair finish_group(cs_over *over, const cs_group *group, cs_over_outer *around) {
  cs_over_pair inner = {over->e, over->t};
  if (!over->is_bound)
    inner = cs_over_develop(group, inner, over->keep);
  float weight = group->fade, keep = over->keep;
  if (group->kind == CS_GROUP_GROUND) {
    inner = cs_over_blend((celspan_blend)group->blend, around->head, inner, &keep);
    over->keep = around->keep * keep;
  } else if (group->kind == CS_GROUP_MATTE) {
    const float strength = over->is_bound ? 0 : cs_over_strength(group, around->head);
    if (group->dissolves)
      inner = cs_over_dissolve(strength, inner);
    else
      weight *= strength;
  } else if (cs_group_keys(group) && over->is_bound) {
    weight = 0;
  }
  return (cs_over_pair){weight * inner.e, (1 - weight) + weight * inner.t};
}

void cs_over_leave_group(cs_over *over) {
  const cs_group *group = &over->stack->groups[over->group];
  cs_over_outer *around = &over->outers[--over->depth];
  while (group->is_frame && over->light < over->stack->light_count)
    cs_over_meet_light(over); /* nothing else of the frame is behind */
  cs_over_pair inner = finish_group(over, group, around), outer = around->outer;
  if (group->kind == CS_GROUP_HEAD) {
    around[-1].head = inner;
    inner = cs_over_pair_clear;
  }
  over->e = outer.e + outer.t * inner.e;
  over->t = outer.t * inner.t;
  over->group = around->group;
}

void cs_over_meet_light(cs_over *over) {
  const cs_back_light *light = &over->stack->lights[over->light++];
  over->e += over->t * light->light;
  over->keep *= light->keep;
}

static void open_group(cs_over *over, uint32_t group) {
  over->outers[over->depth++] =
      (cs_over_outer){{over->e, over->t}, cs_over_pair_clear, over->group, over->keep};
  over->e = cs_v4_all(0);
  over->t = cs_v4_all(1);
  over->group = group;
  if (over->stack->groups[group].kind == CS_GROUP_GROUND)
    over->keep = 1;
}

/* The recursion is at most CS_STACK_GROUPS groups deep. */
static void enter(cs_over *over, uint32_t group) {
  uint32_t parent = cs_stack_around(over->stack, group, over->group);
  if (parent != over->group)
    enter(over, parent);
  open_group(over, group);
}

void cs_over_enter_group(cs_over *over, uint32_t group) {
  uint32_t entered = cs_stack_entered(over->stack, group, over->group);
  if (entered != over->group)
    enter(over, entered);
}

cs_v4 cs_over_end(cs_over *over) {
  while (over->group != CS_STACK_NONE)
    cs_over_leave_group(over);
  while (over->light < over->stack->light_count)
    cs_over_meet_light(over);
  cs_v4 rgba = over->e;
  rgba[3] = 1 - over->keep * cs_over_mean(over->t);
  return rgba;
}
