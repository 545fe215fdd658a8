/* The stack: one compiled frame as the composer reads it, leaves from the rear to the camera.
 *
 * A leaf is one primitive in its place: what it paints and how it is lit. Where it is present is
 * the sweep's affair: a cell of a row is described by the set of leaves present in it, one bit a
 * leaf. Boolean trees turn presence into contribution (compose/tree.c); what contributes is folded
 * front to back, through faded groups, past back lights, until nothing shines through
 * (compose/compose.c).
 *
 * Invariants: leaf i + 1 is nearer the camera than leaf i; every group, tree and back light covers
 * or follows a contiguous range of leaves; nothing here changes while rows are made, so workers
 * share it.
 */
#ifndef CS_COMPOSE_STACK_H
#define CS_COMPOSE_STACK_H

#include <assert.h>

#include "base/vector.h"
#include "colour/paint.h"
#include "sample/defocused.h"
#include "sample/sampler.h"
#include "scene/scene.h"

#define CS_STACK_NONE UINT32_MAX
#define CS_STACK_LAYERS ((size_t)10000000)

typedef enum cs_layer_kind {
  CS_LAYER_FLAT,
  CS_LAYER_SHADED,   /* triangle, linear or radial: varies along a row, as a formula */
  CS_LAYER_PICTURE,  /* varies from pixel to pixel */
  CS_LAYER_SCANLINE, /* paints come with the spans of the row */
  CS_LAYER_DEFOCUSED /* a defocused cel */
} cs_layer_kind;

typedef struct cs_layer {
  cs_v4 s, t;      /* FLAT: light scattered under its front light, and transmission; lane 3 is 0 */
  cs_v4 front;     /* front light of its cel, brightness included; lane 3 is 0 */
  uint32_t group;  /* innermost faded group, or CS_STACK_NONE */
  uint32_t detail; /* SHADED, PICTURE, SCANLINE, SOFT: index into the array of its kind */
  float fade;      /* of its paint, where that varies */
  uint8_t kind;    /* a cs_layer_kind */
  bool is_opaque;  /* lets nothing through, wherever it is present */
} cs_layer;
static_assert(sizeof(cs_layer) == 64, "a leaf fills a line of the cache");

/* What the walk along a row needs of a leaf. */
typedef struct cs_layer_rule {
  uint64_t key[2];      /* names the leaf in the hash of a set */
  int32_t winding_mask; /* inside where (winding & mask) != 0: -1 non-zero, 1 even-odd */
} cs_layer_rule;

/* A formula as planes, value = a x + b y + c.
 * TRIANGLE: premultiplied s, t and beta over own units.
 * LINEAR: where a point lies along the stops, over frame pixels; RADIAL: the two legs of its
 * distance from the centre, as shares of the radius. Both are to be divided by the w of the point
 * unless is_affine. */
typedef struct cs_shade {
  const celspan_texture *texture; /* borrowed from the scene */
  celspan_matrix inverse;         /* frame pixels to own units */
  double plane[7][3];
  bool is_affine; /* and w above 0 everywhere */
} cs_shade;

typedef struct cs_image_layer {
  const celspan_texture *texture;
  celspan_matrix inverse; /* frame pixels to own units */
  celspan_box box;        /* what the picture fills, own units */
  celspan_wrap wrap;
} cs_image_layer;

typedef struct cs_procedure {
  const celspan_scanline_desc *desc; /* borrowed from the scene */
  uint32_t layer;
  double scale_x, shift_x, scale_y, shift_y; /* own units to frame pixels */
} cs_procedure;

/* A faded boolean or cel: composited by itself, then mixed with clear. */
typedef struct cs_group {
  uint32_t parent; /* or CS_STACK_NONE */
  uint32_t first;  /* its first leaf */
  float fade;
} cs_group;

/* A back light, met on the way from the camera before every leaf below `below`. */
typedef struct cs_back_light {
  uint32_t below;
  cs_v4 light; /* brightness included; lane 3 is 0 */
  float keep;  /* 1 - matte */
} cs_back_light;

/* One step of a boolean tree in post-order. */
typedef enum cs_step_kind { CS_STEP_LAYER, CS_STEP_LAYERS, CS_STEP_OPERATOR } cs_step_kind;

typedef struct cs_step {
  cs_step_kind kind;
  celspan_operator op; /* LEAVES: of operands that are all leaves; OPERATOR: of results */
  uint32_t first, end; /* the leaves below */
  uint32_t operands;
} cs_step;

typedef struct cs_tree {
  uint32_t first, end; /* leaves */
  uint32_t step, step_count;
} cs_tree;

typedef struct cs_stack {
  cs_layer *layers;
  cs_layer_rule *rules; /* one a leaf */
  cs_shade *shades;
  cs_image_layer *images;
  cs_procedure *procedures;
  const cs_defocused **defocused; /* the shot's */
  cs_group *groups;
  cs_back_light *lights; /* nearest first */
  cs_step *steps;
  cs_tree *trees; /* disjoint, rear first */
  size_t layer_count, layer_capacity, rule_capacity;
  size_t shade_count, shade_capacity;
  size_t image_count, image_capacity;
  size_t procedure_count, procedure_capacity;
  size_t defocused_count, defocused_capacity;
  size_t group_count, group_capacity;
  size_t light_count, light_capacity;
  size_t step_count, step_capacity;
  size_t tree_count, tree_capacity;
  size_t step_depth; /* results a tree may hold at a time */
} cs_stack;

void cs_stack_finish(cs_stack *stack, cs_memory *memory);

/* The mean of the three channels of a transmission: exactly their value where they are equal. */
static inline float cs_stack_mean(cs_v4 t) {
  return t[0] + ((t[1] - t[0]) + (t[2] - t[0])) * (1.0f / 3);
}

/* ---- sets: one bit a leaf */

static inline size_t cs_stack_words(const cs_stack *stack) {
  return (stack->layer_count + 63) / 64;
}

/* Turns presence into contribution in place: clears the bits of leaves that their boolean trees
 * hide. results: room for step_depth entries. */
typedef struct cs_tree_result {
  uint32_t first, end;
  bool is_present;
} cs_tree_result;
void cs_tree_resolve(const cs_stack *stack, uint64_t *set, cs_tree_result *results);

#endif
