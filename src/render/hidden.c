#include "render/hidden.h"

#include "compose/tree_certain.h"
#include "render/through.h"

#define LAYERS_LEAST 8
#define ROWS_LEAST 20 /* of the frame, for each piece of the outlines, on the average */
#define DEPTH_LEAST 6 /* halvings of light; a tile dies at CS_THROUGH_OPAQUE */

/* ---------------------------------------------------------------- in the words of the cull */

typedef struct hidden {
  const cs_stack *stack;
  cs_cull_layer *layers;
  cs_cull_group *groups;
  cs_cull_tree *trees;
} hidden;

static double most_of(cs_v4 t) {
  float most = t[0] > t[1] ? t[0] : t[1];
  return most > t[2] ? most : t[2];
}

static void resolve(const void *user, size_t tree, const cs_cull_presence *presences, void *scratch,
                    uint64_t *painted) {
  const hidden *h = user;
  cs_tree_certain(h->stack, &h->stack->trees[tree], presences, scratch, painted);
}

static void fill(celspan_context *context, hidden *h) {
  const cs_stack *stack = h->stack;
  for (size_t i = 0; i < stack->layer_count; i++) {
    const cs_layer *layer = &stack->layers[i];
    h->layers[i] = (cs_cull_layer){.through = most_of(cs_through_layer(context, stack, layer)),
                                   .winding_mask = stack->rules[i].winding_mask,
                                   .group = layer->group,
                                   .is_anywhere = layer->kind == CS_LAYER_SCANLINE};
  }
  for (size_t i = 0; i < stack->group_count; i++) {
    const cs_group *group = &stack->groups[i];
    h->groups[i] = (cs_cull_group){group->parent, group->first, (double)group->fade};
  }
  for (size_t i = 0; i < stack->tree_count; i++)
    h->trees[i] = (cs_cull_tree){stack->trees[i].first, stack->trees[i].end};
}

/* ---------------------------------------------------------------- the cull */

static celspan_status cull(cs_compiler *c, const hidden *h) {
  const cs_stack *stack = h->stack;
  const cs_cull_desc desc = {.set = &c->plan->boundaries,
                             .layers = h->layers,
                             .layer_count = stack->layer_count,
                             .groups = h->groups,
                             .group_count = stack->group_count,
                             .trees = h->trees,
                             .tree_count = stack->tree_count,
                             .resolve = resolve,
                             .user = h,
                             .scratch_size = stack->step_depth * sizeof(cs_tree_certain_result),
                             .width = c->plan->width,
                             .height = c->plan->height,
                             .margin = c->plan->margin,
                             .opaque = (double)CS_PAINT_OPAQUE * 0.999,
                             .workers = c->workers};
  return cs_cull_create(c->context, &desc, &c->plan->cull);
}

/* A chain costs the cull about as much as the sweep pays for it in some tens of rows, so it pays
 * where chains are long, and layers so deep that many tiles die. */
static bool pays(const cs_compiler *c) {
  return c->plan->stack.layer_count >= LAYERS_LEAST &&
         c->census.rows >= ROWS_LEAST * c->census.pieces && c->census.depth >= DEPTH_LEAST;
}

celspan_status cs_hidden_cull(cs_compiler *c) {
  const cs_stack *stack = &c->plan->stack;
  cs_memory *memory = c->context->memory;
  if (!pays(c))
    return CELSPAN_OK;
  size_t layers = stack->layer_count, groups = stack->group_count, trees = stack->tree_count;
  hidden h = {stack, cs_mem_array(memory, layers, sizeof *h.layers),
              cs_mem_array(memory, groups, sizeof *h.groups),
              cs_mem_array(memory, trees, sizeof *h.trees)};
  celspan_status status = CELSPAN_OK;
  if ((!h.layers && layers > 0) || (!h.groups && groups > 0) || (!h.trees && trees > 0))
    status = cs_fail_memory(c->context);
  if (status == CELSPAN_OK) {
    fill(c->context, &h);
    status = cull(c, &h);
  }
  cs_mem_free(memory, h.layers, layers * sizeof *h.layers);
  cs_mem_free(memory, h.groups, groups * sizeof *h.groups);
  cs_mem_free(memory, h.trees, trees * sizeof *h.trees);
  return status;
}
