/* Layers one over the other, folded from the camera backwards: the light gathered so far (e), and
 * the share of what lies behind that still shines through (t), channel by channel.
 *
 *       camera
 *          |               e = 0, t = 1
 *       layer 9            add:   e += t * s9, t *= t9
 *          |
 *      +-- | ---+          enter a faded group: e and t are put aside,
 *      | layer 8|                 and inside it begins again with 0 and 1
 *      | layer 7|
 *      +-- | ---+          leave: lit and faded as a whole, it is added to what was put aside;
 *          |                      the head of a ground or a matte is kept for that group instead
 *          |
 *      =========           meet a back light: e += t * light;
 *          |                      its matte takes its share of the transparency
 *       layer 5
 *          |
 *        rear              colour e, alpha = 1 - keep * the mean of t
 *
 * Before a layer is added three moves may be due, in this order: leave the groups that end in front
 * of it, meet the back lights in front of it, enter the groups it is in.
 *
 * The same fold is written seven times, since it must be fast on seven kinds of data:
 *   over.h            one cell, layer by layer;
 *   over_table.h      one cell of a frame that has flat layers only, without groups, of which
 *                     dozens are seen at once: most layers of neighbouring cells are the same, so
 *                     their light is looked up;
 *   engine/paint/over_row.h  up to 256 pixels of one program at once, a register at a time; modes
 *                            are blended by over_blend_wide.c;
 *   engine/paint/over_channels.h  the same for gradients that dim all channels alike;
 *   engine/paint/over_bare.h  the same for pictures alone, shown unchanged;
 *   engine/map/sheets.h  drawings that have a map, one over the other;
 *   engine/area/crowd_solver.c  what the edges in one pixel of a crowd divide.
 * Names and arithmetic are the same in the first three.
 */
#pragma once

#include "engine/compose/stack.h"
#include "model/colour/blend.h"
#include "model/colour/primaries.h"
#include "model/colour/space.h"

/* The light and the transmission of some layers by themselves. Lane 3 of e has no meaning. */
typedef struct cs_over_pair {
  cs_v4 e, t;
} cs_over_pair;

static const cs_over_pair cs_over_pair_clear = {{0, 0, 0, 0}, {1, 1, 1, 1}};

/* One pair over another. Where one of them is clear, the result is exactly the other. */
static inline cs_over_pair cs_over_pair_over(cs_over_pair front, cs_over_pair back) {
  return (cs_over_pair){front.e + front.t * back.e, front.t * back.t};
}

/* The light that a paint adds in its layer: its light under the front light of its cel, faded into
 * clear. The loops of engine/paint/over_row_wide.c do the same for many pixels. */
static inline cs_over_pair cs_over_lit(cs_v4 front, float fade, cs_v4 s, cs_v4 t) {
  return (cs_over_pair){front * (fade * s), (1 - fade) + fade * t};
}

/* Whether nothing shines through. Lane 3 of a transmission is 0 once something has been painted. */
static inline bool cs_over_is_opaque(cs_v4 t) {
  return !cs_v4_any_above(t, cs_v4_all(CS_PAINT_OPAQUE));
}

/* The mean of the three channels of a transmission: exactly their value where they are equal. */
static inline float cs_over_mean(cs_v4 t) {
  return t[0] + ((t[1] - t[0]) + (t[2] - t[0])) * (1.0f / 3);
}

/* ---- groups: what several of the folds do alike with one that is left */

/* The alpha of a colour that transmits t. keep: the share of t that the mattes behind it leave. */
static inline float cs_over_alpha(cs_v4 t, float keep) { return 1 - keep * cs_over_mean(t); }

/* The colour of premultiplied light, clamped to 0..1. */
static inline cs_v4 cs_over_colour(cs_v4 e, float alpha) {
  return alpha > 0 ? cs_v4_min(cs_v4_max(e * (1 / alpha), cs_v4_all(0)), cs_v4_all(1))
                   : cs_v4_all(0);
}

/* A source over its backdrop. keep: the share of the backdrop's transparency that the mattes of
 * back lights leave; it becomes 1 where the result's t includes it. */
static inline cs_over_pair cs_over_blend(celspan_blend mode, cs_over_pair source, cs_over_pair back,
                                         float *keep) {
  float as = cs_over_alpha(source.t, 1), ab = cs_over_alpha(back.t, *keep);
  if (mode == CELSPAN_BLEND_ADD) {
    cs_v4 t = cs_v4_max(source.t - (1 - *keep * back.t), cs_v4_all(0));
    *keep = 1;
    return (cs_over_pair){source.e + back.e, t};
  }
  cs_v4 both = cs_blend_colour(CS_BLEND_MODE(mode), cs_over_colour(back.e, ab),
                               cs_over_colour(source.e, as));
  if ((unsigned)mode & CS_BLEND_WITHIN)
    return (cs_over_pair){(1 - as) * back.e + (as * ab) * both, back.t};
  return (cs_over_pair){(1 - ab) * source.e + (1 - as) * back.e + (as * ab) * both,
                        source.t * back.t};
}

static inline cs_v4 cs_over_grade(const cs_group *group, cs_over_pair pair, float keep) {
  float light[4];
  cs_v4_store(light, pair.e);
  cs_grade_light(group->grade, (celspan_space)group->space, cs_over_alpha(pair.t, keep), light);
  return cs_v4_load(light);
}

/* The share of a keyed group that stays, without spill. */
static inline cs_over_pair cs_over_key(const cs_group *group, cs_over_pair pair) {
  float stays = cs_keying_light(&group->grade->keying, (celspan_space)group->space,
                                cs_over_alpha(pair.t, 1), &pair.e);
  return (cs_over_pair){stays * pair.e, (1 - stays) + stays * pair.t};
}

/* Finishes a group as a whole: it is graded, converted to the space around it, then lit. keep: the
 * share of a frame's transparency that the mattes of its back lights leave. */
static inline cs_over_pair cs_over_develop(const cs_group *group, cs_over_pair pair, float keep) {
  keep = group->is_frame ? keep : 1;
  if (cs_group_keys(group))
    pair = cs_over_key(group, pair);
  else if (group->grade)
    pair.e = cs_over_grade(group, pair, keep);
  if (group->converts != CELSPAN_SPACE_AROUND)
    pair.e = cs_space_leave((celspan_space)group->converts, pair.e, pair.t, keep);
  if (group->has_front)
    pair.e = cs_over_lit(group->front, 1, pair.e, pair.t).e;
  return pair;
}

/* The share of the art that a matte keeps. head: the composited layers of the matte. */
static inline float cs_over_strength(const cs_group *group, cs_over_pair head) {
  float luma = CS_LUMA(float, head.e[0], head.e[1], head.e[2]);
  float m = group->is_luma ? luma : cs_over_alpha(head.t, 1);
  m = m > 0 ? m : 0;
  m = m < 1 ? m : 1;
  return group->inverts ? 1 - m : m;
}

/* The art of a matte that dissolves: opaque with its own colour, or clear. */
static inline cs_over_pair cs_over_dissolve(float strength, cs_over_pair art) {
  float alpha = cs_over_alpha(art.t, 1);
  if (!(strength > 1 - alpha))
    return cs_over_pair_clear;
  return (cs_over_pair){art.e * (1 / alpha), cs_v4_all(0)};
}

/* A group that has been entered and not yet left. */
typedef struct cs_over_outer {
  cs_over_pair outer; /* the state of the group around it, kept while this group is folded */
  cs_over_pair head;  /* GROUND and MATTE; clear until its head has been left */
  uint32_t group;     /* the group around it, entered before, or CS_STACK_NONE */
  float keep;         /* what mattes of back lights leave in the group around it */
} cs_over_outer;

/* A fold under way. */
typedef struct cs_over {
  const cs_stack *stack;
  cs_v4 e, t;     /* light and transmission of the innermost group */
  float keep;     /* the share of transparency that the mattes of back lights leave */
  uint32_t group; /* the innermost that was entered, or CS_STACK_NONE */
  size_t light;   /* the next back light to be met */
  uint32_t depth;
  /* only the most that may shine through is wanted: that is t, and e has no meaning */
  bool is_bound;
  cs_over_outer *outers; /* borrowed; room for cs_stack_depth of them */
} cs_over;

/* Enters a group and the groups around it that were not entered yet. A ground whose head was not
 * met is never entered, even if it is `group`. */
void cs_over_enter_group(cs_over *over, uint32_t group);

/* outers: as above; NULL where no layer to come is in a group. */
static inline void cs_over_begin(cs_over *over, const cs_stack *stack, cs_over_outer *outers) {
  over->stack = stack;
  over->outers = outers;
  over->is_bound = false;
  over->e = cs_v4_all(0);
  over->t = cs_v4_all(1);
  over->keep = 1;
  over->group = CS_STACK_NONE;
  over->light = 0;
  over->depth = 0;
  if (stack->has_root)
    cs_over_enter_group(over, 0);
}

void cs_over_leave_group(cs_over *over);
void cs_over_meet_light(cs_over *over);

/* Leaves the groups that end in front of a layer. */
static inline void cs_over_leave(cs_over *over, uint32_t layer) {
  while (over->group != CS_STACK_NONE && layer < over->stack->groups[over->group].first)
    cs_over_leave_group(over);
}

/* Moves back to just in front of a layer, which is in `group`. */
static inline void cs_over_move(cs_over *over, uint32_t layer, uint32_t group) {
  cs_over_leave(over, layer);
  while (over->light < over->stack->light_count && layer < over->stack->lights[over->light].below)
    cs_over_meet_light(over);
  if (group != over->group)
    cs_over_enter_group(over, group);
}

static inline void cs_over_add(cs_over *over, cs_v4 s, cs_v4 t) {
  over->e += over->t * s;
  over->t *= t;
}

/* Leaves the groups that end in front of a layer, and returns whether anything shines through then:
 * a faded group may have been the last one needed to hide everything behind it. */
static inline bool cs_over_reaches(cs_over *over, uint32_t layer) {
  if (over->group == CS_STACK_NONE || layer >= over->stack->groups[over->group].first)
    return true;
  cs_over_leave(over, layer);
  return !cs_over_is_opaque(over->t);
}

/* Where the fold continues once nothing shines through: behind the innermost group that veils,
 * which hides the rest of itself, or nowhere. */
static inline uint32_t cs_over_hidden_end(const cs_over *over) {
  uint32_t group = cs_stack_veil(over->stack, over->group);
  return group == CS_STACK_NONE ? 0 : over->stack->groups[group].first;
}

/* Premultiplied RGBA; alpha is the mean of the three mattes. */
cs_v4 cs_over_end(cs_over *over);
