#include "engine/paint/over_channels.h"

#define WIDE(painter, name) CS_WIDE_CHOOSE((painter)->isa, name)

/* Whether the only effect of a group is that a light with a shape lights it. */
static bool group_fits(const cs_stack *stack, uint32_t index) {
  const cs_group *group = &stack->groups[index];
  return stack->light_count == 0 && group->parent == CS_STACK_NONE &&
         group->kind == CS_GROUP_PLAIN && group->fade == 1 && !group->grade && !group->has_front &&
         group->converts == CELSPAN_SPACE_AROUND;
}

/* layer: in front of all back lights. */
static bool layer_fits(const cs_stack *stack, const cs_layer *layer) {
  if (layer->kind == CS_LAYER_FLAT)
    return layer->role == CS_LAYER_PAINT && layer->t[0] == layer->t[1] &&
           layer->t[1] == layer->t[2];
  return layer->kind == CS_LAYER_SHADED && layer->role != CS_LAYER_BACK &&
         stack->shades[layer->index].is_even;
}

bool cs_over_channels_fits(const cs_stack *stack, const cs_program *program) {
  uint32_t gradients = 0, below = stack->light_count > 0 ? stack->lights[0].below : 0;
  bool fits = stack->shade_count > 1 && !stack->has_root && program->length > 0;
  const uint32_t group = fits ? stack->layers[program->items[0].layer].group : CS_STACK_NONE;
  for (uint32_t i = 0; i < program->length && fits; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    fits = program->items[i].layer >= below && layer->group == group && layer_fits(stack, layer);
    gradients += layer->kind == CS_LAYER_SHADED;
  }
  return fits && gradients > 1 && (group == CS_STACK_NONE || group_fits(stack, group));
}

static inline void add_layer(cs_painter *painter, const cs_layer *layer, const cs_batch *batch,
                             cs_over_channels *pixels) {
  const cs_shade *shade =
      layer->kind == CS_LAYER_FLAT ? NULL : &painter->stack->shades[layer->index];
  if (shade && !shade->is_steady) {
    WIDE(painter, cs_over_channels_add_shade)(pixels, layer, shade, batch);
    return;
  }
  const cs_over_pair lit =
      shade ? cs_painter_lit_steady(painter, layer, batch->y) : (cs_over_pair){layer->s, layer->t};
  WIDE(painter, cs_over_channels_add_flat)(pixels, &lit);
}

/* Folds such a program for the pixels of a batch: a front light by itself, as a layer that is not
 * faded. */
static void fold(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                 cs_over_channels *out) {
  const cs_stack *stack = painter->stack;
  cs_over_channels front;
  cs_layer light = {.role = CS_LAYER_PAINT};
  painter->evaluations += (uint64_t)batch->count;
  WIDE(painter, cs_over_channels_clear)(out, batch->count);
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    const bool is_light = layer->role == CS_LAYER_FRONT;
    if (is_light) {
      light = *layer;
      light.fade = 1;
      WIDE(painter, cs_over_channels_clear)(&front, batch->count);
    }
    add_layer(painter, is_light ? &light : layer, batch, is_light ? &front : out);
  }
  if (light.role == CS_LAYER_FRONT)
    WIDE(painter, cs_over_channels_light)(out, &front);
  for (size_t i = 0; i < stack->light_count; i++) {
    WIDE(painter, cs_over_channels_add_light)(out, (const float *)&stack->lights[i].light);
    out->keep *= stack->lights[i].keep;
  }
}

/* ---------------------------------------------------------------- ahead */

static inline bool is_of(const cs_over_channels_ahead *ahead, const cs_program *program) {
  for (uint32_t i = 0; i < program->length; i++)
    if (ahead->layers[i] != program->items[i].layer)
      return false;
  return ahead->length > 0;
}

/* What has been folded ahead from column x0 up to x1; NULL: not all of it. */
static inline const cs_over_channels_ahead *find_ahead(const cs_painter *painter,
                                                       const cs_program *program, cs_run run) {
  for (int i = 0; i < 2; i++) {
    const cs_over_channels_ahead *ahead = &painter->ahead[i];
    if (ahead->length == program->length && ahead->run.x0 <= run.x0 && run.x1 <= ahead->run.x1 &&
        ahead->run.y == run.y && is_of(ahead, program))
      return ahead;
  }
  return NULL;
}

void cs_over_channels_prepare(cs_painter *painter, const cs_program *program, cs_run run) {
  const int32_t count = run.x1 - run.x0;
  if (count > CS_OVER_ROW_BATCH || program->length > CS_OVER_CHANNELS_ITEMS ||
      find_ahead(painter, program, run) || !cs_over_channels_fits(painter->stack, program))
    return;
  cs_over_channels_ahead *ahead = &painter->ahead[painter->next_ahead];
  painter->next_ahead = !painter->next_ahead;
  fold(painter, program, &(cs_batch){NULL, run.x0, count, run.y}, &ahead->pixels);
  for (uint32_t i = 0; i < program->length; i++)
    ahead->layers[i] = program->items[i].layer;
  ahead->length = program->length;
  ahead->run = run;
}

/* ---------------------------------------------------------------- colours */

static inline cs_run run_of(const cs_batch *batch) {
  if (!batch->columns)
    return (cs_run){batch->x0, batch->x0 + batch->count, batch->y};
  return (cs_run){batch->columns[0], batch->columns[batch->count - 1] + 1, batch->y};
}

/* Premultiplied RGBA of a pixel. */
static inline void put_colour(const cs_over_channels *pixels, int32_t k, float *rgba) {
  const float alpha = 1 - pixels->keep * pixels->through[k];
  cs_v4_store(rgba, (cs_v4){pixels->light[0][k], pixels->light[1][k], pixels->light[2][k], alpha});
}

/* The same for `count` pixels from a first one on. */
static void put_colours(const cs_over_channels *pixels, int32_t first, int32_t count,
                        float (*rgba)[4]) {
  int32_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const cs_v4 r = cs_v4_load(pixels->light[0] + first + k);
    const cs_v4 g = cs_v4_load(pixels->light[1] + first + k);
    const cs_v4 b = cs_v4_load(pixels->light[2] + first + k);
    const cs_v4 a = 1 - pixels->keep * cs_v4_load(pixels->through + first + k);
    const cs_v4 rg = __builtin_shufflevector(r, g, 0, 4, 1, 5);
    const cs_v4 ba = __builtin_shufflevector(b, a, 0, 4, 1, 5);
    const cs_v4 next_rg = __builtin_shufflevector(r, g, 2, 6, 3, 7);
    const cs_v4 next_ba = __builtin_shufflevector(b, a, 2, 6, 3, 7);
    const cs_v4 four[4] = {__builtin_shufflevector(rg, ba, 0, 1, 4, 5),
                           __builtin_shufflevector(rg, ba, 2, 3, 6, 7),
                           __builtin_shufflevector(next_rg, next_ba, 0, 1, 4, 5),
                           __builtin_shufflevector(next_rg, next_ba, 2, 3, 6, 7)};
    for (int32_t i = 0; i < 4; i++)
      cs_v4_store(rgba[k + i], four[i]);
  }
  for (; k < count; k++)
    put_colour(pixels, first + k, rgba[k]);
}

static void copy_ready(const cs_over_channels_ahead *ahead, const cs_batch *batch,
                       float (*rgba)[4]) {
  for (int32_t k = 0; k < batch->count && batch->columns; k++)
    put_colour(&ahead->pixels, batch->columns[k] - ahead->run.x0, rgba[k]);
  if (!batch->columns)
    put_colours(&ahead->pixels, batch->x0 - ahead->run.x0, batch->count, rgba);
}

bool cs_over_channels_ready(const cs_painter *painter, const cs_program *program,
                            const cs_batch *batch, float (*rgba)[4]) {
  const cs_over_channels_ahead *ahead = find_ahead(painter, program, run_of(batch));
  if (ahead)
    copy_ready(ahead, batch, rgba);
  return ahead != NULL;
}

bool cs_over_channels_colours(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                              float (*rgba)[4]) {
  cs_over_channels pixels;
  if (!cs_over_channels_fits(painter->stack, program))
    return false;
  fold(painter, program, batch, &pixels);
  put_colours(&pixels, 0, batch->count, rgba);
  return true;
}

bool cs_over_channels_codes(cs_painter *painter, const cs_program *program, const cs_batch *batch,
                            unsigned char *codes) {
  const cs_over_channels_ahead *ahead =
      batch->columns || !painter->ahead ? NULL : find_ahead(painter, program, run_of(batch));
  cs_over_channels pixels;
  const int32_t first = ahead ? batch->x0 - ahead->run.x0 : 0;
  if (!ahead && !cs_over_channels_fits(painter->stack, program))
    return false;
  if (!ahead)
    fold(painter, program, batch, &pixels);
  WIDE(painter, cs_over_channels_to_codes)
  (ahead ? &ahead->pixels : &pixels, first, batch->count, codes);
  return true;
}
