/* The stack: one compiled frame as the composer reads it, layers from the rear to the camera.
 *
 *     camera
 *       layer n - 1   \
 *       ...            > a group, a boolean tree: each a range of neighbouring layers
 *       layer k       /
 *       - - - - - - -   a back light: between layers
 *       ...
 *       layer 0
 *     rear
 *
 * A cell of a row is described by the set of layers present in it, one bit a layer. Boolean trees
 * turn presence into contribution (engine/compose/tree.h). The contributing layers are laid over
 * each other from the camera backwards, until nothing shines through (engine/compose/over.h).
 *
 * Invariants: layer i + 1 is nearer the camera than layer i; every group, tree and back light
 * covers or follows a range of neighbouring layers; nothing here changes while rows are made, so
 * workers share it.
 */
#pragma once

#include "base/arrays.h"
#include "engine/compose/layer.h"

#define CS_STACK_LAYERS ((size_t)10000000)
/* Groups around a layer, at most, without the grounds that modes need: a cel may be lit, faded,
 * graded and a source, which are four, the frame may be one, and at each level of nesting there is
 * a faded object, a source, what leaves for another space, a matte and the group that it fades, or
 * a faded composition as a whole and a cel. */
#define CS_STACK_GROUPS (6 * CS_SCENE_DEPTH + 5)

/* One step of a boolean tree in post-order. Before the first step of an operator there may be a
 * guard: where none of its layers is present, the operator is absent, and its steps are skipped. */
typedef enum cs_step_kind {
  CS_STEP_GUARD,
  CS_STEP_LAYER,
  CS_STEP_LAYERS,
  CS_STEP_OPERATOR,
  CS_STEP_FRAME /* a rostrum that is an object: it is present where its first layer is present */
} cs_step_kind;

typedef struct cs_step {
  cs_step_kind kind;
  celspan_operator op; /* LAYERS: all operands are layers; OPERATOR: the operands are results */
  /* the range of layers; GUARD: layers of which the operator needs at least one */
  uint32_t first, end;
  /* FRAME: the number of results of the trees inside it; GUARD: the number of guarded steps */
  uint32_t operands;
} cs_step;

typedef struct cs_tree {
  uint32_t first, end; /* layers */
  uint32_t step, step_count;
} cs_tree;

typedef struct cs_stack {
  CS_ARRAY(cs_layer, layers);
  CS_ARRAY(cs_layer_rule, rules); /* one for each layer */
  CS_ARRAY(cs_shade, shades);
  CS_ARRAY(cs_image_layer, images);
  CS_ARRAY(cs_group, groups);
  CS_ARRAY(cs_step, steps);
  CS_ARRAY(cs_tree, trees); /* disjoint, rear first */
  CS_ARRAY(cs_procedure, procedures);
  /* borrowed from the plan: engine/sample/defocused.h */
  CS_ARRAY(const struct cs_defocused *, defocused);
  CS_ARRAY(cs_back_light, lights); /* nearest first */
  /* textures that were made for the frame: of its shades, with codes as pigments; pictures of
   * patterns; owned */
  CS_ARRAY(celspan_texture *, coded);
  size_t layer_count, shade_count, image_count, group_count, step_count, tree_count;
  size_t procedure_count, defocused_count, light_count, coded_count;
  size_t source_count; /* groups with a mode: as many grounds may be inside each other */
  celspan_space space; /* the space of the numbers in rows */
  bool has_root;       /* group 0 is the whole frame: it is entered in every cell */
  /* the error that gradient spans may have, as a share of full scale; 0: 1/1023 */
  float span_error;
  size_t step_depth;    /* the number of results that a tree may need to keep at a time */
  bool has_group_light; /* any group has a light with a shape */
  bool has_curves;      /* any group curves */
  bool has_sources;     /* any group is a source */
} cs_stack;

void cs_stack_finish(cs_stack *stack, cs_memory *memory);
/* Its contents. */
size_t cs_stack_bytes(const cs_stack *stack);

/* Whether a layer of paint dims the three channels alike, unless it is a defocused cel. */
bool cs_stack_layer_is_grey(const cs_stack *stack, const cs_layer *layer);

/* The innermost group, `group` itself or one around it, whose opaque contents do not hide what lies
 * behind the group. CS_STACK_NONE: there is none. */
static inline uint32_t cs_stack_veil(const cs_stack *stack, uint32_t group) {
  while (group != CS_STACK_NONE && stack->groups[group].fade == 1 &&
         stack->groups[group].kind == CS_GROUP_PLAIN && !cs_group_keys(&stack->groups[group]))
    group = stack->groups[group].parent;
  return group;
}

/* The innermost group that has to be entered for a layer of `group`, or for a group in it that is
 * no head: `group` itself, unless `group` is a ground whose head was not met. now: the innermost
 * group that has been entered, which is around the layer. */
static inline uint32_t cs_stack_entered(const cs_stack *stack, uint32_t group, uint32_t now) {
  while (group != CS_STACK_NONE && group != now && stack->groups[group].kind == CS_GROUP_GROUND) {
    const cs_group *ground = &stack->groups[group];
    if (now != CS_STACK_NONE && stack->groups[now].kind == CS_GROUP_GROUND &&
        stack->groups[now].innermost == ground->innermost)
      return now;
    group = ground->around;
  }
  return group;
}

/* The same for a group that is about to be entered. For a head, the group that it is the head
 * of. */
static inline uint32_t cs_stack_around(const cs_stack *stack, uint32_t group, uint32_t now) {
  uint32_t parent = stack->groups[group].parent;
  return stack->groups[group].kind == CS_GROUP_HEAD ? parent : cs_stack_entered(stack, parent, now);
}

/* Groups that may be entered and not yet left at a time. */
static inline size_t cs_stack_depth(const cs_stack *stack) {
  size_t most = CS_STACK_GROUPS + 2 * stack->source_count;
  return stack->group_count < most ? stack->group_count : most;
}

/* Words of a set of layers, one bit a layer. */
static inline size_t cs_stack_words(const cs_stack *stack) {
  return (stack->layer_count + 63) / 64;
}
