#include "engine/compose/stack.h"

void cs_stack_finish(cs_stack *stack, cs_memory *memory) {
  for (size_t i = 0; i < stack->coded_count; i++)
    celspan_texture_unref(stack->coded[i]);
  CS_ARRAYS_FREE(memory, stack, layers, coded);
  *stack = (cs_stack){0};
}

size_t cs_stack_bytes(const cs_stack *stack) { return CS_ARRAYS_BYTES(stack, layers, trees); }

bool cs_stack_layer_is_grey(const cs_stack *stack, const cs_layer *layer) {
  const celspan_texture *texture =
      layer->kind == CS_LAYER_SHADED    ? stack->shades[layer->index].texture
      : layer->kind == CS_LAYER_PICTURE ? stack->images[layer->index].texture
                                        : NULL;
  bool is_flat_grey = layer->t[0] == layer->t[1] && layer->t[1] == layer->t[2];
  return texture ? cs_texture_is_grey(texture) : is_flat_grey;
}
