#include "engine/paint/shown.h"

/* Columns that defocused cels are asked for at a time. */
#define STRIDE CS_PICTURE_BLOCK

static const cs_v4 clear = {1, 1, 1, 0};

/* What is known of an item in some columns. */
typedef struct bound {
  cs_v4 through; /* the most that each channel lets through there */
  bool is_clear; /* the layer is clear in all columns */
  bool is_sure;  /* no single column is known better than all columns together */
} bound;

/* ---------------------------------------------------------------- bounds */

static cs_v4 faded(float fade, cs_v4 through) { return (1 - fade) + fade * through; }

static celspan_status bound_picture(cs_painter *painter, const cs_layer *layer, cs_run run,
                                    bound *out) {
  const cs_image_view *view;
  cs_picture_opacity opacity = CS_PICTURE_OPAQUE;
  const cs_texture_variation *variation = painter->stack->images[layer->index].texture->variation;
  if (variation->medium)
    return CELSPAN_OK;
  CS_TRY(cs_painter_image(painter, layer->index, &view));
  if (!view->is_opaque)
    CS_TRY(cs_sampler_opacity(painter->blocks, &view->sampler, run, &opacity));
  out->is_clear = opacity == CS_PICTURE_CLEAR;
  out->is_sure = opacity != CS_PICTURE_MIXED;
  if (opacity == CS_PICTURE_OPAQUE && variation->use != CELSPAN_PICTURE_GEL)
    out->through = cs_v4_all(1 - layer->fade);
  return CELSPAN_OK;
}

/* is_last: nothing behind the layer could be hidden by it. */
static celspan_status bound_defocused(cs_painter *painter, const cs_layer *layer, bool is_last,
                                      cs_run run, bound *out) {
  const cs_defocused *defocused = painter->stack->defocused[layer->index];
  cs_defocused_view *view = &painter->defocused[layer->index];
  CS_TRY(cs_defocused_move(defocused, painter->context, view, run.y));
  if (cs_shown_is_pixels(painter->stack, layer)) {
    cs_defocused_range visible = cs_defocused_visible(defocused, view);
    out->is_clear = run.x1 <= visible.first || run.x0 >= visible.end;
    out->is_sure =
        out->is_clear || (visible.first < run.x0 + STRIDE && visible.end > run.x1 - STRIDE);
  }
  if (out->is_clear || is_last)
    return CELSPAN_OK;
  cs_v4 through = cs_defocused_through(defocused, view, run);
  out->is_sure = cs_over_is_opaque(through);
  out->through = faded(layer->fade, through);
  return CELSPAN_OK;
}

/* Finds a bound of a layer in some columns. is_last: no layer behind this one would have to be read
 * or made. */
static celspan_status find_bound(cs_painter *painter, const cs_layer *layer, bool is_last,
                                 cs_run run, bound *out) {
  *out = (bound){layer->role == CS_LAYER_FRONT ? clear : layer->t, .is_sure = true};
  if (layer->role != CS_LAYER_PAINT)
    return CELSPAN_OK;
  if (layer->kind == CS_LAYER_PICTURE)
    return bound_picture(painter, layer, run, out);
  bool is_asked =
      cs_shown_is_pixels(painter->stack, layer) || (layer->kind == CS_LAYER_DEFOCUSED && !is_last);
  return is_asked ? bound_defocused(painter, layer, is_last, run, out) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- programs */

static cs_layer_kind kind_of(const cs_stack *stack, const cs_program *program, uint32_t i) {
  return stack->layers[program->items[i].layer].kind;
}

/* The number of items up to the rearmost item that would have to be read or made. */
static uint32_t count_dear(const cs_stack *stack, const cs_program *program) {
  uint32_t count = program->length;
  while (count > 0 && kind_of(stack, program, count - 1) != CS_LAYER_PICTURE &&
         kind_of(stack, program, count - 1) != CS_LAYER_DEFOCUSED)
    count--;
  return count;
}

bool cs_shown_varies(const cs_stack *stack, const cs_program *program) {
  uint32_t defocused = 0;
  if (stack->image_count == 0 && stack->defocused_count == 0)
    return false;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_PICTURE || (layer->kind == CS_LAYER_DEFOCUSED &&
                                            (++defocused == 2 || cs_shown_is_pixels(stack, layer))))
      return true;
  }
  return false;
}

int32_t cs_shown_stride(cs_painter *painter, const cs_program *program) {
  uint32_t dear = count_dear(painter->stack, program);
  int32_t columns = INT32_MAX;
  for (uint32_t i = 0; i < dear; i++) {
    const cs_layer *layer = &painter->stack->layers[program->items[i].layer];
    const cs_image_view *view;
    if (layer->kind == CS_LAYER_DEFOCUSED && columns > STRIDE &&
        (i + 1 < dear || cs_shown_is_pixels(painter->stack, layer)))
      columns = STRIDE;
    if (layer->kind == CS_LAYER_PICTURE &&
        cs_painter_image(painter, layer->index, &view) == CELSPAN_OK && !view->is_opaque &&
        view->sampler.opacity_columns < columns)
      columns = view->sampler.opacity_columns;
  }
  return columns;
}

celspan_status cs_shown_find(cs_painter *painter, const cs_program *program, cs_run run,
                             cs_shown *out) {
  const cs_stack *stack = painter->stack;
  cs_over over;
  painter->examined++;
  CS_TRY(CS_ARRAY_RESERVE(painter->context, out->items, program->length));
  out->length = 0;
  out->is_sure = true;
  out->ends_opaque = false;
  uint32_t dear = count_dear(stack, program), end = UINT32_MAX;
  cs_over_begin(&over, stack, painter->outers);
  over.is_bound = true;
  for (uint32_t i = 0; i < program->length && end > 0; i++) {
    cs_item item = program->items[i];
    const cs_layer *layer = &stack->layers[item.layer];
    if (item.layer < end && cs_over_reaches(&over, item.layer)) {
      bound known;
      CS_TRY(find_bound(painter, layer, i + 1 >= dear, run, &known));
      cs_over_move(&over, item.layer, layer->group);
      if (!known.is_clear)
        out->items[out->length++] = item;
      out->is_sure &= known.is_sure;
      over.t *= known.through;
    }
    end = cs_over_is_opaque(over.t) ? cs_over_hidden_end(&over) : UINT32_MAX;
  }
  out->ends_opaque = end == 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- kept */

/* Programs are compared by their items, since one may be made where another was. */
static bool is_of(const cs_shown_kept *kept, const cs_program *program) {
  return kept->length == program->length &&
         memcmp(kept->asked, program->items, program->length * sizeof *program->items) == 0;
}

celspan_status cs_shown_keep(cs_painter *painter, const cs_program *program, cs_shown_kept **out) {
  const uint32_t first = program->items[0].layer, last = program->items[program->length - 1].layer;
  cs_shown_kept *kept = &painter->kept[(first + 3 * last + 5 * program->length) % CS_PAINTER_SHOWN];
  *out = kept;
  if (is_of(kept, program))
    return CELSPAN_OK;
  kept->length = 0;
  kept->run = (cs_run){0};
  CS_TRY(CS_ARRAY_RESERVE(painter->context, kept->asked, program->length));
  memcpy(kept->asked, program->items, program->length * sizeof *program->items);
  kept->length = program->length;
  kept->stride = cs_shown_stride(painter, program);
  return CELSPAN_OK;
}

celspan_status cs_shown_again(cs_painter *painter, cs_shown_kept *kept, cs_run run) {
  if (kept->run.x0 == run.x0 && kept->run.x1 == run.x1 && kept->run.y == run.y)
    return CELSPAN_OK;
  const cs_program program = {.items = kept->asked, .length = kept->length};
  kept->run = (cs_run){0};
  CS_TRY(cs_shown_find(painter, &program, run, &kept->shown));
  kept->run = run;
  return CELSPAN_OK;
}

bool cs_shown_same(const cs_shown *a, const cs_shown *b) {
  return a->length == b->length && a->ends_opaque == b->ends_opaque &&
         (a->length == 0 || memcmp(a->items, b->items, a->length * sizeof *a->items) == 0);
}
