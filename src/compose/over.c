#include "compose/over.h"

void cs_over_leave_group(cs_over *over) {
  const cs_group *group = &over->stack->groups[over->group];
  const cs_over_pair *outer = &over->outer[--over->depth];
  over->e = outer->e + outer->t * (group->fade * over->e);
  over->t = outer->t * ((1 - group->fade) + group->fade * over->t);
  over->group = group->parent;
}

void cs_over_meet_light(cs_over *over) {
  const cs_back_light *light = &over->stack->lights[over->light++];
  over->e += over->t * light->light;
  over->keep *= light->keep;
}

void cs_over_enter_group(cs_over *over, uint32_t group) {
  const cs_group *inner = &over->stack->groups[group];
  if (inner->parent != over->group)
    cs_over_enter_group(over, inner->parent); /* at most CS_STACK_GROUPS levels */
  over->outer[over->depth++] = (cs_over_pair){over->e, over->t};
  over->e = cs_v4_all(0);
  over->t = cs_v4_all(1);
  over->group = group;
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
