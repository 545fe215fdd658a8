#include "engine/paint/over_planes.h"

#define WIDE(painter, name) CS_WIDE_CHOOSE((painter)->isa, name)

/* layer: in front of all back lights. */
static bool layer_fits(const cs_stack *stack, const cs_layer *layer) {
  if (layer->role != CS_LAYER_PAINT || layer->group != CS_STACK_NONE)
    return false;
  if (layer->kind == CS_LAYER_FLAT)
    return layer->t[0] == layer->t[1] && layer->t[1] == layer->t[2];
  return layer->kind == CS_LAYER_SHADED && stack->shades[layer->index].is_even;
}

bool cs_over_planes_fits(const cs_stack *stack, const cs_program *program) {
  uint32_t gradients = 0, below = stack->light_count > 0 ? stack->lights[0].below : 0;
  bool fits = stack->shade_count > 1 && !stack->has_root;
  for (uint32_t i = 0; i < program->length && fits; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    fits = program->items[i].layer >= below && layer_fits(stack, layer);
    gradients += layer->kind == CS_LAYER_SHADED;
  }
  return fits && gradients > 1;
}

void cs_over_planes_fold(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                         cs_over_planes *out) {
  const cs_stack *stack = painter->stack;
  WIDE(painter, cs_over_planes_clear)(out, batch->count);
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    const cs_shade *shade = layer->kind == CS_LAYER_FLAT ? NULL : &stack->shades[layer->index];
    if (shade && !shade->is_steady) {
      WIDE(painter, cs_over_planes_add_shade)(out, layer, shade, batch);
      continue;
    }
    const cs_over_pair lit = shade ? cs_painter_lit_steady(painter, layer, batch->y)
                                   : (cs_over_pair){layer->s, layer->t};
    WIDE(painter, cs_over_planes_add_flat)(out, &lit);
  }
  for (size_t i = 0; i < stack->light_count; i++) {
    WIDE(painter, cs_over_planes_add_light)(out, (const float *)&stack->lights[i].light);
    out->keep *= stack->lights[i].keep;
  }
}
