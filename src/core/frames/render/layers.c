#include "frames/render/layers.h"

#include <math.h>

#include "engine/compose/over.h"
#include "engine/paint/shade.h"
#include "frames/render/through.h"
#include "model/geometry/matrix.h"
#include "model/scene/texture.h"
#include "model/stroke/kept.h"
#include "model/stroke/outliner.h"

void cs_layers_fill_flat(cs_layer *layer, cs_paint paint, float fade) {
  cs_paint faded = cs_paint_fade(paint, fade);
  layer->kind = CS_LAYER_FLAT;
  cs_v4 s = {faded.s[0], faded.s[1], faded.s[2], 0}, t = {faded.t[0], faded.t[1], faded.t[2], 0};
  layer->s = cs_over_lit(layer->front, 1, s, t).e;
  layer->t = t;
}

/* The most that a layer transmits after it is faded, if it transmits at most `t` before. */
static cs_v4 faded_through(float fade, cs_v4 t) {
  cs_v4 faded = (1 - fade) + fade * t;
  faded[3] = 0;
  return faded;
}

/* Replaces a texture by one whose pigments are codes, which belongs to the stack. */
static celspan_status code_texture(cs_compiler *c, const celspan_texture **texture) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, coded, coded_count));
  celspan_texture *coded;
  CS_TRY(cs_texture_create_coded(c->context, *texture, &coded));
  stack->coded[stack->coded_count++] = coded;
  *texture = coded;
  return CELSPAN_OK;
}

/* From pixels to the texture's own units. */
static celspan_matrix texture_inverse(const cs_layers_texture *place) {
  const cs_texture_variation *variation = place->texture->variation;
  return variation->has_matrix ? celspan_matrix_then(place->inverse, variation->inverse)
                               : place->inverse;
}

static celspan_status fill_shaded(cs_compiler *c, cs_layer *layer, const cs_layers_texture *place) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, shades, shade_count));
  cs_shade *shade = &stack->shades[stack->shade_count];
  *shade = (cs_shade){.texture = place->texture, .inverse = texture_inverse(place)};
  if (c->space == CELSPAN_SPACE_SRGB)
    CS_TRY(code_texture(c, &shade->texture));
  cs_shade_prepare(shade);
  layer->kind = CS_LAYER_SHADED;
  layer->index = (uint32_t)stack->shade_count++;
  layer->t = faded_through(layer->fade, cs_through_shade(shade, &place->visible));
  return CELSPAN_OK;
}

/* A picture that fills its primitive's rectangle is clamped at its edges, because the boundary
 * decides where it ends, not the picture. */
static celspan_status fill_picture(cs_compiler *c, cs_layer *layer,
                                   const cs_layers_texture *place) {
  cs_stack *stack = &c->plan->stack;
  const celspan_texture *texture = place->texture;
  const celspan_box *box = texture->variation->has_box ? &texture->variation->box : &place->bounds;
  if (box->width <= 0 || box->height <= 0) {
    cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1);
    return CELSPAN_OK;
  }
  CS_TRY(CS_COMPILER_APPEND(c, images, image_count));
  bool is_own = place->ends_at_bounds && !texture->variation->has_box &&
                texture->variation->wrap == CELSPAN_WRAP_CLEAR;
  celspan_wrap wrap = is_own ? CELSPAN_WRAP_CLAMP : texture->variation->wrap;
  stack->images[stack->image_count] =
      (cs_image_layer){texture, texture_inverse(place), *box, wrap, c->space};
  layer->kind = CS_LAYER_PICTURE;
  layer->index = (uint32_t)stack->image_count++;
  layer->t = faded_through(1, cs_v4_all(1));
  return CELSPAN_OK;
}

celspan_status cs_layers_fill(cs_compiler *c, cs_layer *layer, const cs_layers_texture *place) {
  if (layer->fade == 0)
    cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1);
  else if (place->texture->kind == CS_TEXTURE_FLAT)
    cs_layers_fill_flat(layer, cs_space_paint(c->space, place->texture->flat), layer->fade);
  else
    return place->texture->kind == CS_TEXTURE_PICTURE ? fill_picture(c, layer, place)
                                                      : fill_shaded(c, layer, place);
  return CELSPAN_OK;
}

celspan_status cs_layers_append(cs_compiler *c, double fade, celspan_rule rule, uint32_t *index) {
  cs_stack *stack = &c->plan->stack;
  if (stack->layer_count == CS_STACK_LAYERS)
    return cs_fail(c->context, CELSPAN_LIMIT, "cel %zu%s: more than %zu primitives in one frame",
                   c->cel, cs_mark_describe(c->mark).text, (size_t)CS_STACK_LAYERS);
  CS_TRY(CS_COMPILER_APPEND(c, layers, layer_count));
  CS_TRY(CS_COMPILER_APPEND(c, rules, layer_count));
  *index = (uint32_t)stack->layer_count++;
  stack->layers[*index] =
      (cs_layer){.group = c->group, .front = c->front, .fade = c->fades_out ? 0 : (float)fade};
  cs_hash key = cs_hash_begin(*index);
  key = cs_hash_end(key);
  stack->rules[*index] = (cs_layer_rule){{key.a, key.b}, rule == CELSPAN_RULE_EVENODD ? 1 : -1};
  return CELSPAN_OK;
}

/* Adds an outline with this number of pieces, in a rectangle, to the census. */
static void count_outline(cs_compiler *c, size_t pieces, const cs_layer *layer,
                          const cs_boundary_frame *around) {
  const cs_boundary_frame *frame = &c->frame;
  double width = fmin(around->right, frame->right) - fmax(around->left, frame->left);
  double height = fmin(around->bottom, frame->bottom) - fmax(around->top, frame->top);
  double all = (frame->right - frame->left) * (frame->bottom - frame->top);
  if (!(width > 0 && height > 0))
    return;
  c->census.pieces += (double)pieces;
  c->census.rows += height;
  cs_v4 through = cs_through_least(&c->plan->stack, layer);
  c->census.depth += width * height / all * cs_through_halvings(through);
}

/* Takes an outline into the census. Returns whether it is on the rows that are asked for. */
static bool is_asked_for(cs_compiler *c, size_t pieces, const celspan_box *bounds,
                         const celspan_matrix *facing, uint32_t index) {
  cs_boundary_frame around;
  if (!cs_boundary_around_box(bounds, facing, &around))
    around = c->frame;
  count_outline(c, pieces, &c->plan->stack.layers[index], &around);
  return around.bottom >= c->first_height && around.top <= c->end_height;
}

celspan_status cs_layers_add_outline(cs_compiler *c, const cs_outline *outline,
                                     const celspan_box *bounds, const celspan_matrix *matrix,
                                     uint32_t index) {
  celspan_matrix facing = cs_matrix_facing(matrix);
  return is_asked_for(c, outline->piece_count, bounds, &facing, index) && !c->plan->is_crowded
             ? cs_boundary_add(c->boundaries, outline, matrix, index)
             : CELSPAN_OK;
}

/* Counts the dashes of a stroke that are in view. Returns whether the plan may have these dashes in
 * addition. */
static bool takes_dashes(cs_compiler *c, const cs_stroke *stroke, const cs_stroke_view *view) {
  cs_plan *plan = c->plan;
  size_t left = c->most_dashes - plan->dash_count;
  if (plan->is_crowded)
    return false;
  size_t count = cs_stroke_count_visible(stroke, view, left);
  plan->is_crowded = count > left;
  plan->dash_count += plan->is_crowded ? 0 : count;
  return !plan->is_crowded;
}

static celspan_status add_kept(cs_compiler *c, const cs_stroke *stroke, const cs_stroke_view *view,
                               uint32_t index) {
  cs_stroke_kept *kept;
  CS_TRY(cs_stroke_kept_acquire(c->context, stroke, view, &kept));
  celspan_status status = cs_boundary_add(c->boundaries, &kept->outline, &view->matrix, index);
  cs_stroke_kept_release(c->context, kept);
  return status;
}

/* The outline of a stroke is made only as far as the requested rows show it. The census counts
 * numbers that do not depend on these rows: two sides of its line and two ends of each of its
 * parts. */
static celspan_status add_stroke(cs_compiler *c, const cs_primitive_data *data,
                                 const celspan_matrix *facing, uint32_t index) {
  const cs_stroke *stroke = data->stroke;
  const cs_stroke_view view = {.matrix = *facing,
                               .frame = c->frame,
                               .tolerance = CS_STROKE_TOLERANCE,
                               .top = c->first_height,
                               .bottom = c->end_height,
                               .left = c->first_place,
                               .right = c->end_place};
  size_t pieces = 2 * (stroke->line.piece_count + stroke->part_count);
  if (!is_asked_for(c, pieces, &data->bounds, facing, index) || !takes_dashes(c, stroke, &view))
    return CELSPAN_OK;
  if (cs_stroke_kept_suits(stroke, &view))
    return add_kept(c, stroke, &view, index);
  cs_outline outline;
  cs_outline_init(&outline);
  celspan_status status = cs_stroke_outline(c->context, stroke, &view, &outline);
  if (status == CELSPAN_OK)
    status = cs_boundary_add(c->boundaries, &outline, facing, index);
  cs_outline_finish(&outline, c->context->memory);
  return status;
}

static celspan_status add_outline(cs_compiler *c, const cs_primitive_data *data, double fade,
                                  const celspan_matrix *matrix) {
  uint32_t index;
  cs_layers_texture place = {data->texture, data->bounds, true, {{0}}, c->frame};
  CS_TRY(cs_layers_append(c, fade, data->rule, &index));
  cs_layer *layer = &c->plan->stack.layers[index];
  celspan_matrix facing = cs_matrix_facing(matrix);
  if (!celspan_matrix_inverse(facing, &place.inverse)) {
    cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1); /* it has no area */
    return CELSPAN_OK;
  }
  if (!cs_boundary_around_box(&data->bounds, &facing, &place.visible))
    place.visible = c->frame;
  CS_TRY(cs_layers_fill(c, layer, &place));
  if (data->stroke)
    return add_stroke(c, data, &facing, index);
  cs_outline_box room;
  return cs_layers_add_outline(c, cs_primitive_data_outline(data, &room), &data->bounds, matrix,
                               index);
}

static celspan_status add_scanline(cs_compiler *c, const cs_primitive_data *data, double fade,
                                   const celspan_matrix *matrix) {
  cs_stack *stack = &c->plan->stack;
  const double *m = matrix->m;
  uint32_t index = 0;
  CS_TRY(cs_layers_append(c, fade, CELSPAN_RULE_NONZERO, &index));
  cs_layers_fill_flat(&stack->layers[index], CS_PAINT_CLEAR, 1);
  if (!cs_matrix_is_upright(matrix))
    return cs_fail(
        c->context, CELSPAN_BAD_ARGUMENT,
        "cel %zu%s: a scan-line primitive can be moved and scaled, but not rotated, skewed "
        "or put in perspective",
        c->cel, cs_mark_describe(c->mark).text);
  if (m[0] == 0 || m[4] == 0)
    return CELSPAN_OK;
  CS_TRY(CS_COMPILER_APPEND(c, procedures, procedure_count));
  stack->procedures[stack->procedure_count] = (cs_procedure){
      data->scanline, index, m[0] / m[8], m[2] / m[8], m[4] / m[8], m[5] / m[8], c->space};
  stack->layers[index].kind = CS_LAYER_SCANLINE;
  stack->layers[index].index = (uint32_t)stack->procedure_count++;
  return CELSPAN_OK;
}

celspan_status cs_layers_add(cs_compiler *c, const cs_primitive_data *data, double fade,
                             const celspan_matrix *matrix) {
  return data->kind == CS_PRIMITIVE_DATA_SCANLINE ? add_scanline(c, data, fade, matrix)
                                                  : add_outline(c, data, fade, matrix);
}
