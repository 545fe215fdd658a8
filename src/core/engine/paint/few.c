/* The colours of a few pixels, each folded by itself (engine/compose/over.h).
 *
 *     window   |  | cell a / cell b |  |      a boundary crosses one or two pixels, and each cell
 *              |  |       /         |  |      is asked for its colour in them
 *
 * For a few pixels the states of whole batches (over_row.h) cost more than what is folded.
 *
 * Invariant: the arithmetic is the same as in over_row.h.
 */
#include "engine/paint/colours.h"

#include "engine/paint/shade.h"

bool cs_few_fits(const cs_stack *stack, const cs_program *program) {
  uint32_t defocused = 0, made = 0; /* made: layers that would be made even where they are hidden */
  uint32_t formulas = 0;
  if (stack->defocused_count + stack->shade_count == 0)
    return false;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    bool is_formula = layer->kind == CS_LAYER_SHADED && layer->role == CS_LAYER_PAINT;
    if (layer->kind != CS_LAYER_FLAT && layer->kind != CS_LAYER_DEFOCUSED && !is_formula)
      return false;
    formulas += is_formula;
    if (layer->kind == CS_LAYER_DEFOCUSED) {
      defocused++;
      made += !stack->defocused[layer->index]->are_pixels;
    }
  }
  if (defocused == 0)
    return formulas > 1;                                      /* one alone is read from a table */
  return defocused == 1 || (made == 0 && stack->has_sources); /* in such a stack little is hidden */
}

static celspan_status move_views(cs_painter *painter, const cs_program *program, double y) {
  const cs_stack *stack = painter->stack;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_DEFOCUSED)
      CS_TRY(cs_defocused_move(stack->defocused[layer->index], painter->context,
                               &painter->defocused[layer->index], y));
  }
  return CELSPAN_OK;
}

static void add_formula(cs_painter *painter, const cs_layer *layer, int32_t x, double y,
                        cs_over *over) {
  const cs_shade *shade = &painter->stack->shades[layer->index];
  cs_over_pair lit;
  if (shade->is_steady) {
    lit = cs_painter_lit_steady(painter, layer, y);
  } else {
    cs_shade_lanes paint = cs_shade_paint(shade, x + 0.5, y);
    lit = cs_over_lit(layer->front, layer->fade, paint.s, paint.t);
  }
  cs_over_add(over, lit.e, lit.t);
}

static void add_defocused(const cs_painter *painter, const cs_layer *layer, int32_t x,
                          cs_over *over) {
  const cs_defocused_places place = {NULL, x, 1};
  float s[1][4], t[1][4];
  cs_defocused_paints(painter->stack->defocused[layer->index], &painter->defocused[layer->index],
                      &place, s, t);
  cs_over_pair lit = cs_over_lit(layer->front, layer->fade, cs_v4_load(s[0]), cs_v4_load(t[0]));
  cs_over_add(over, lit.e, lit.t);
}

/* Whether a layer is known to be clear at a column. */
static bool is_clear(const cs_painter *painter, const cs_layer *layer, int32_t x) {
  const cs_defocused *defocused =
      layer->kind == CS_LAYER_DEFOCUSED ? painter->stack->defocused[layer->index] : NULL;
  if (!defocused || !defocused->are_pixels)
    return false;
  cs_defocused_range visible = cs_defocused_visible(defocused, &painter->defocused[layer->index]);
  return x < visible.first || x >= visible.end;
}

static cs_v4 colour_at(cs_painter *painter, const cs_program *program, int32_t x, double y) {
  cs_over over;
  cs_over_begin(&over, painter->stack, painter->outers);
  for (uint32_t i = 0; i < program->length; i++) {
    uint32_t number = program->items[i].layer;
    const cs_layer *layer = &painter->stack->layers[number];
    if (is_clear(painter, layer, x))
      continue;
    cs_over_move(&over, number, layer->group);
    if (layer->kind == CS_LAYER_FLAT)
      cs_over_add(&over, layer->s, layer->t);
    else if (layer->kind == CS_LAYER_SHADED)
      add_formula(painter, layer, x, y, &over);
    else
      add_defocused(painter, layer, x, &over);
  }
  return cs_over_end(&over);
}

celspan_status cs_few_colours(cs_painter *painter, const cs_program *program, cs_run run,
                              float (*rgba)[4]) {
  painter->evaluations += (uint64_t)(run.x1 - run.x0);
  CS_TRY(move_views(painter, program, run.y));
  for (int32_t x = run.x0; x < run.x1; x++)
    cs_v4_store(rgba[x - run.x0], colour_at(painter, program, x, run.y));
  return CELSPAN_OK;
}
