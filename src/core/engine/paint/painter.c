#include "engine/paint/painter.h"

#include "engine/paint/gradient_table.h"

/* ---------------------------------------------------------------- life */

celspan_status cs_painter_init(cs_painter *painter, celspan_context *context, const cs_stack *stack,
                               const cs_composer *composer) {
  *painter =
      (cs_painter){.context = context, .composer = composer, .stack = stack, .isa = cs_isa_best()};
  cs_arena_init(&painter->scratch);
  CS_TRY(CS_ARRAY_MAKE(context, painter->outers, cs_stack_depth(stack)));
  CS_TRY(CS_ARRAY_MAKE(context, painter->images, stack->image_count));
  CS_TRY(CS_ARRAY_MAKE(context, painter->blocks, stack->image_count > 0));
  if (painter->blocks)
    cs_block_cache_init(painter->blocks, context);
  CS_TRY(CS_ARRAY_MAKE(context, painter->copies, stack->image_count > 0 ? CS_PAINTER_COPIES : 0));
  const bool may_vary = stack->image_count + stack->defocused_count > 0;
  CS_TRY(CS_ARRAY_MAKE(context, painter->kept, may_vary ? CS_PAINTER_SHOWN : 0));
  CS_TRY(CS_ARRAY_MAKE(context, painter->defocused, stack->defocused_count));
  if (stack->shade_count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_MAKE(context, painter->steady, stack->shade_count));
  const bool may_fold = stack->shade_count > 1 && !stack->has_root; /* over_channels.h */
  CS_TRY(CS_ARRAY_MAKE(context, painter->ahead, may_fold ? 2 : 0));
  return cs_gradient_tables_create(context, stack, painter->isa, &painter->scratch,
                                   &painter->gradients);
}

void cs_painter_finish(cs_painter *painter) {
  if (!painter->stack)
    return;
  cs_memory *memory = painter->context->memory;
  const cs_stack *stack = painter->stack;
  if (painter->blocks)
    cs_block_cache_finish(painter->blocks);
  for (size_t i = 0; painter->defocused && i < stack->defocused_count; i++)
    cs_defocused_release(stack->defocused[i], painter->context, &painter->defocused[i]);
  for (size_t i = 0; i < painter->copies_room.capacity; i++)
    CS_ARRAYS_FREE(memory, &painter->copies[i], items, pieces);
  for (size_t i = 0; i < painter->kept_room.capacity; i++) {
    CS_ARRAYS_FREE(memory, &painter->kept[i], asked, asked);
    CS_ARRAYS_FREE(memory, &painter->kept[i].shown, items, items);
  }
  for (int i = 0; i < 2; i++)
    CS_ARRAYS_FREE(memory, &painter->shown[i], items, items);
  CS_ARRAYS_FREE(memory, painter, outers, kept);
  cs_gradient_tables_destroy(painter->gradients, memory);
  cs_arena_finish(&painter->scratch, memory);
  *painter = (cs_painter){0};
}

/* ---------------------------------------------------------------- image layers */

static void prepare_sampler(const cs_painter *painter, const cs_image_layer *layer,
                            const cs_picture *picture, const celspan_picture_info *info,
                            cs_sampler *sampler) {
  const celspan_box *box = &layer->box;
  celspan_matrix to_picture = {{info->width / box->width, 0, -box->x * info->width / box->width, 0,
                                info->height / box->height, -box->y * info->height / box->height, 0,
                                0, 1}};
  *sampler = (cs_sampler){.picture = picture,
                          .inverse = celspan_matrix_then(layer->inverse, to_picture),
                          .width = info->width,
                          .height = info->height,
                          .sampling = layer->texture->variation->sampling,
                          .wrap = layer->wrap,
                          .isa = painter->isa};
  cs_sampler_prepare(sampler);
}

celspan_status cs_painter_image(cs_painter *painter, uint32_t image, const cs_image_view **out) {
  cs_image_view *view = &painter->images[image];
  *out = view;
  if (view->is_ready)
    return CELSPAN_OK;
  const cs_image_layer *layer = &painter->stack->images[image];
  const cs_texture_variation *variation = layer->texture->variation;
  const cs_picture *picture = variation->picture, *medium = variation->medium;
  celspan_picture_info info, medium_info;
  CS_TRY(cs_store_info(painter->context, picture, &info));
  if (medium) {
    CS_TRY(cs_store_info(painter->context, medium, &medium_info));
    prepare_sampler(painter, layer, medium, &medium_info, &view->medium);
  }
  prepare_sampler(painter, layer, picture, &info, &view->sampler);
  view->is_opaque = !info.has_alpha && cs_image_layer_hides(layer);
  view->is_ready = true;
  return CELSPAN_OK;
}

static bool is_opaque(void *painter, uint32_t image) {
  const cs_image_view *view;
  return cs_painter_image(painter, image, &view) == CELSPAN_OK && view->is_opaque;
}

cs_image_opacity cs_painter_opacity(cs_painter *painter) {
  return (cs_image_opacity){is_opaque, painter};
}

/* ---------------------------------------------------------------- steady shades */

cs_over_pair cs_painter_lit_steady(cs_painter *painter, const cs_layer *layer, double y) {
  cs_painter_steady *known = &painter->steady[layer->index];
  if (!known->is_found || known->y != y)
    *known =
        (cs_painter_steady){cs_shade_paint(&painter->stack->shades[layer->index], 0, y), y, true};
  return cs_over_lit(layer->front, layer->fade, known->paint.s, known->paint.t);
}
