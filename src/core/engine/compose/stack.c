#include "engine/compose/stack.h"

void cs_stack_finish(cs_stack *stack, cs_memory *memory) {
  cs_mem_free(memory, stack->layers, stack->layer_capacity * sizeof *stack->layers);
  cs_mem_free(memory, stack->rules, stack->rule_capacity * sizeof *stack->rules);
  cs_mem_free(memory, stack->shades, stack->shade_capacity * sizeof *stack->shades);
  cs_mem_free(memory, stack->images, stack->image_capacity * sizeof *stack->images);
  cs_mem_free(memory, stack->procedures, stack->procedure_capacity * sizeof *stack->procedures);
  cs_mem_free(memory, stack->defocused, stack->defocused_capacity * sizeof *stack->defocused);
  cs_mem_free(memory, stack->groups, stack->group_capacity * sizeof *stack->groups);
  cs_mem_free(memory, stack->lights, stack->light_capacity * sizeof *stack->lights);
  cs_mem_free(memory, stack->steps, stack->step_capacity * sizeof *stack->steps);
  cs_mem_free(memory, stack->trees, stack->tree_capacity * sizeof *stack->trees);
  for (size_t i = 0; i < stack->coded_count; i++)
    celspan_texture_unref(stack->coded[i]);
  cs_mem_free(memory, stack->coded, stack->coded_capacity * sizeof *stack->coded);
  *stack = (cs_stack){0};
}

size_t cs_stack_bytes(const cs_stack *stack) {
  return stack->layer_capacity * sizeof *stack->layers +
         stack->rule_capacity * sizeof *stack->rules +
         stack->shade_capacity * sizeof *stack->shades +
         stack->image_capacity * sizeof *stack->images +
         stack->group_capacity * sizeof *stack->groups +
         stack->step_capacity * sizeof *stack->steps + stack->tree_capacity * sizeof *stack->trees;
}

bool cs_stack_layer_is_grey(const cs_stack *stack, const cs_layer *layer) {
  const celspan_texture *texture =
      layer->kind == CS_LAYER_SHADED    ? stack->shades[layer->index].texture
      : layer->kind == CS_LAYER_PICTURE ? stack->images[layer->index].texture
                                        : NULL;
  bool is_flat_grey = layer->t[0] == layer->t[1] && layer->t[1] == layer->t[2];
  return texture ? cs_texture_is_grey(texture) : is_flat_grey;
}
