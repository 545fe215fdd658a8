#include "render/objects.h"

#include "geometry/matrix.h"
#include "render/behind.h"
#include "render/layers.h"
#include "render/lights.h"

static celspan_status add_object(cs_compiler *c, const celspan_object *object,
                                 const celspan_matrix *parent);

/* ---------------------------------------------------------------- groups */

celspan_status cs_objects_begin_group(cs_compiler *c, double fade, bool is_lit,
                                      cs_objects_outside *outer) {
  cs_stack *stack = &c->plan->stack;
  *outer = (cs_objects_outside){c->group, c->fades_out};
  c->fades_out |= fade == 0;
  if ((fade == 1 && !is_lit) || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(CS_COMPILER_APPEND(c, groups, group_count, group_capacity));
  bool varies = is_lit || (c->group != CS_STACK_NONE && stack->groups[c->group].varies);
  stack->groups[stack->group_count] = (cs_group){.parent = c->group,
                                                 .first = (uint32_t)stack->layer_count,
                                                 .fade = (float)fade,
                                                 .varies = varies};
  c->group = (uint32_t)stack->group_count++;
  return CELSPAN_OK;
}

void cs_objects_end_group(cs_compiler *c, cs_objects_outside outer) {
  c->group = outer.group;
  c->fades_out = outer.fades_out;
}

/* ---------------------------------------------------------------- trees */

static celspan_status append_step(cs_compiler *c, cs_step step) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, steps, step_count, step_capacity));
  stack->steps[stack->step_count++] = step;
  return CELSPAN_OK;
}

static bool is_layer(const celspan_object *object) {
  cs_primitive_data_kind kind = object->data->kind;
  return kind == CS_PRIMITIVE_DATA_OUTLINE || kind == CS_PRIMITIVE_DATA_SCANLINE;
}

static bool operands_are_layers(const cs_primitive_data *data) {
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (!is_layer(data->boolean->operands[i]))
      return false;
  return true;
}

/* An operator: the layers of its operands, and the step that combines them. */
static celspan_status add_operator(cs_compiler *c, const cs_primitive_data *data,
                                   const celspan_matrix *matrix) {
  uint32_t first = (uint32_t)c->plan->stack.layer_count;
  bool records = c->records, over_layers = operands_are_layers(data);
  for (size_t i = 0; i < data->boolean->operand_count; i++) {
    uint32_t layer = (uint32_t)c->plan->stack.layer_count;
    c->records = records && !over_layers;
    CS_TRY(add_object(c, data->boolean->operands[i], matrix));
    if (c->records && is_layer(data->boolean->operands[i]))
      CS_TRY(append_step(c, (cs_step){.kind = CS_STEP_LAYER, .first = layer, .end = layer + 1}));
  }
  c->records = records;
  if (!records)
    return CELSPAN_OK;
  return append_step(c, (cs_step){.kind = over_layers ? CS_STEP_LAYERS : CS_STEP_OPERATOR,
                                  .op = data->boolean->op,
                                  .first = first,
                                  .end = (uint32_t)c->plan->stack.layer_count,
                                  .operands = (uint32_t)data->boolean->operand_count});
}

/* Unions of unions need no steps: every layer that is present is painted. A rostrum has a tree of
 * its own. */
static bool is_plain_union(const cs_primitive_data *data) {
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return true;
  if (data->boolean->op != CELSPAN_UNION)
    return false;
  for (size_t i = 0; i < data->boolean->operand_count; i++)
    if (!is_plain_union(data->boolean->operands[i]->data))
      return false;
  return true;
}

/* The greatest number of results that the steps of a tree keep at a time. */
static size_t measure_depth(const cs_stack *stack, const cs_tree *tree) {
  size_t depth = 0, most = 0;
  for (uint32_t i = 0; i < tree->step_count; i++) {
    const cs_step *step = &stack->steps[tree->step + i];
    if (step->kind == CS_STEP_OPERATOR || step->kind == CS_STEP_FRAME)
      depth -= step->operands;
    depth++;
    most = depth > most ? depth : most;
  }
  return most;
}

/* A tree begins with the next layer. */
static cs_tree begin_tree(const cs_compiler *c) {
  const cs_stack *stack = &c->plan->stack;
  return (cs_tree){.first = (uint32_t)stack->layer_count, .step = (uint32_t)stack->step_count};
}

static celspan_status end_tree(cs_compiler *c, cs_tree tree) {
  cs_stack *stack = &c->plan->stack;
  tree.end = (uint32_t)stack->layer_count;
  tree.step_count = (uint32_t)stack->step_count - tree.step;
  CS_TRY(CS_COMPILER_APPEND(c, trees, tree_count, tree_capacity));
  stack->trees[stack->tree_count++] = tree;
  size_t depth = measure_depth(stack, &tree) + 1;
  stack->step_depth = depth > stack->step_depth ? depth : stack->step_depth;
  return CELSPAN_OK;
}

/* A boolean object. One that is not an operand of another is the root of a tree, unless it needs no
 * steps, or is inside a rostrum: then it belongs to the tree of that. */
static celspan_status add_boolean(cs_compiler *c, const cs_primitive_data *data,
                                  const celspan_matrix *matrix) {
  if (c->records || is_plain_union(data))
    return add_operator(c, data, matrix);
  cs_tree tree = begin_tree(c);
  c->records = true;
  CS_TRY(add_operator(c, data, matrix));
  c->records = false;
  c->results++;
  return c->is_nested ? CELSPAN_OK : end_tree(c, tree);
}

/* ---------------------------------------------------------------- a rostrum inside another */

/* The layer of its frame: clear, but for what the mattes of its flat back lights hold back. */
static celspan_status add_frame(cs_compiler *c, const cs_primitive_data *data,
                                const celspan_matrix *matrix) {
  uint32_t index;
  float keep = c->fades_out ? 1 : cs_lights_keep(data->rostrum);
  CS_TRY(cs_layers_append(c, 1, CELSPAN_RULE_NONZERO, &index));
  cs_layer *layer = &c->plan->stack.layers[index];
  cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1);
  layer->t = (cs_v4){keep, keep, keep, 0};
  cs_outline_box room;
  return cs_layers_add_outline(c, cs_primitive_data_outline(data, &room), &data->bounds, matrix,
                               index);
}

/* Its layers, and the step that cuts them at the frame and leaves one result. */
static celspan_status add_framed(cs_compiler *inner, const cs_primitive_data *data,
                                 const celspan_matrix *matrix) {
  const cs_stack *stack = &inner->plan->stack;
  const celspan_rostrum *rostrum = data->rostrum;
  cs_outline_box room;
  const cs_compiler_film film = {rostrum->width, rostrum->height, *matrix, inner->front,
                                 cs_primitive_data_outline(data, &room)};
  uint32_t first = (uint32_t)stack->layer_count;
  CS_TRY(add_frame(inner, data, matrix));
  CS_TRY(inner->compile_nested(inner, rostrum, &film));
  return append_step(inner, (cs_step){.kind = CS_STEP_FRAME,
                                      .first = first,
                                      .end = (uint32_t)stack->layer_count,
                                      .operands = inner->results});
}

/* What changes inside is the compiler's copy, which has the same plan. */
static celspan_status add_rostrum(cs_compiler *c, const cs_primitive_data *data,
                                  const celspan_matrix *matrix) {
  cs_compiler inner = *c;
  cs_tree tree = begin_tree(c);
  inner.records = false;
  inner.is_nested = true;
  inner.results = 0;
  CS_TRY(add_framed(&inner, data, matrix));
  c->results += !c->records;
  return c->records || c->is_nested ? CELSPAN_OK : end_tree(c, tree);
}

/* ---------------------------------------------------------------- objects */

static celspan_status add_object(cs_compiler *c, const celspan_object *object,
                                 const celspan_matrix *parent) {
  const cs_primitive_data *data = object->data;
  celspan_matrix matrix = celspan_matrix_then(*object->matrix, *parent);
  if (is_layer(object))
    return cs_layers_add(c, data, object->fade, &matrix);
  cs_objects_outside outer;
  CS_TRY(cs_objects_begin_group(c, object->fade, false, &outer));
  CS_TRY(data->kind == CS_PRIMITIVE_DATA_ROSTRUM ? add_rostrum(c, data, &matrix)
                                                 : add_boolean(c, data, &matrix));
  cs_objects_end_group(c, outer);
  return CELSPAN_OK;
}

/* Those that are not behind others. */
static celspan_status add_visible(cs_compiler *c, celspan_object *const *objects,
                                  const cs_behind *behind, const celspan_matrix *matrix) {
  for (size_t i = 0; i < behind->count; i++)
    if (!cs_behind_has(behind, i))
      CS_TRY(add_object(c, objects[i], matrix));
  return CELSPAN_OK;
}

celspan_status cs_objects_add(cs_compiler *c, celspan_object *const *objects, size_t count,
                              const celspan_matrix *matrix) {
  cs_behind behind;
  CS_TRY(cs_behind_find(c, objects, count, matrix, &behind));
  celspan_status status = add_visible(c, objects, &behind, matrix);
  cs_behind_finish(&behind, c->context->memory);
  return status;
}
