#include "frames/render/lights.h"

#include "frames/render/layers.h"
#include "model/geometry/matrix.h"
#include "model/scene/texture_fit.h"

static cs_v4 colour_of(celspan_light light) { return (cs_v4){light.r, light.g, light.b, 0}; }

static cs_v4 grey(double x) { return (cs_v4){(float)x, (float)x, (float)x, 0}; }

/* A light of a film, multiplied by the light that falls on the film from outside. */
static cs_v4 under_shine(const cs_compiler_film *film, cs_v4 light) {
  return film->outline ? cs_v4_min(film->shine * light, cs_v4_all(CS_LAYER_BRIGHTEST)) : light;
}

/* Frame pixels to the units in which a light with a shape is given; false where it has no area. */
static celspan_status find_inverse(const cs_compiler *c, const celspan_rostrum *rostrum,
                                   size_t index, const cs_light *light,
                                   const cs_compiler_film *film, celspan_matrix *out, bool *found) {
  celspan_matrix matrix = cs_scene_camera(rostrum, film->width, film->height);
  if (light->on == CELSPAN_LIGHT_ON_CEL)
    CS_TRY(cs_scene_cel_matrix(c->context, rostrum, index, film->width, film->height, &matrix));
  matrix = cs_texture_fit_light(light->texture, &matrix, film->width, film->height);
  matrix = celspan_matrix_then(matrix, film->to_pixels);
  *found = celspan_matrix_inverse(cs_matrix_facing(&matrix), out);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- layers as large as the film */

/* Makes a layer present in the whole film. */
static celspan_status add_film_outline(cs_compiler *c, const cs_compiler_film *film,
                                       uint32_t index) {
  const celspan_matrix identity = celspan_matrix_identity();
  const celspan_box box = {0, 0, film->width, film->height};
  if (film->outline)
    return cs_layers_add_outline(c, film->outline, &box, &film->to_pixels, index);
  const cs_boundary_frame *frame = &c->frame;
  cs_outline plane;
  cs_outline_init(&plane);
  celspan_status status =
      cs_outline_rect(c->context, &plane, frame->left, frame->top, frame->right - frame->left,
                      frame->bottom - frame->top, 0);
  if (status == CELSPAN_OK)
    status = cs_boundary_add(c->boundaries, &plane, &identity, index);
  cs_outline_finish(&plane, c->context->memory);
  return status;
}

/* A layer of a light with a shape. front: the factor of its pigments. fade: of its paint. */
static celspan_status append_shape(cs_compiler *c, const cs_light *light,
                                   const cs_compiler_film *film, const celspan_matrix *inverse,
                                   cs_v4 front, double fade, uint32_t *index) {
  const cs_layers_texture place = {
      light->texture, {0, 0, film->width, film->height}, false, *inverse, c->frame};
  CS_TRY(cs_layers_append(c, fade, CELSPAN_RULE_NONZERO, index));
  cs_layer *layer = &c->plan->stack.layers[*index];
  layer->front = front;
  return cs_layers_fill(c, layer, &place);
}

/* ---------------------------------------------------------------- mattes */

float cs_lights_keep(const celspan_rostrum *rostrum) {
  float keep = 1 - rostrum->back.flat.a;
  for (size_t i = 0; i < rostrum->cel_count; i++)
    keep *= 1 - rostrum->cels[i]->back.flat.a;
  return keep;
}

static celspan_status add_flat_matte(cs_compiler *c, float matte, const cs_compiler_film *film) {
  uint32_t layer;
  if (matte == 0 || c->fades_out)
    return CELSPAN_OK;
  CS_TRY(cs_layers_append(c, 1, CELSPAN_RULE_NONZERO, &layer));
  cs_layers_fill_flat(&c->plan->stack.layers[layer], CS_PAINT_CLEAR, 1);
  c->plan->stack.layers[layer].t = grey((double)(1 - matte));
  return add_film_outline(c, film, layer);
}

/* The pigments of the layer are not lit, so that only its T counts, which is 1 - matte * beta. */
static celspan_status add_matte(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                const cs_light *back, const cs_compiler_film *film) {
  celspan_matrix inverse;
  bool found;
  uint32_t layer;
  if (!back->texture)
    return film->outline && cs_rostrum_blends(rostrum, c->space)
               ? add_flat_matte(c, back->flat.a, film)
               : CELSPAN_OK;
  if (back->matte == 0)
    return CELSPAN_OK;
  CS_TRY(find_inverse(c, rostrum, index, back, film, &inverse, &found));
  if (!found)
    return CELSPAN_OK;
  CS_TRY(append_shape(c, back, film, &inverse, cs_v4_all(0), back->matte, &layer));
  return add_film_outline(c, film, layer);
}

celspan_status cs_lights_add_mattes(cs_compiler *c, const celspan_rostrum *rostrum,
                                    const cs_compiler_film *film, uint32_t *firsts) {
  for (size_t i = rostrum->cel_count; i-- > 0;) {
    firsts[i] = (uint32_t)c->plan->stack.layer_count;
    CS_TRY(add_matte(c, rostrum, i, &rostrum->cels[i]->back, film));
  }
  return add_matte(c, rostrum, 0, &rostrum->back, film);
}

/* ---------------------------------------------------------------- back lights */

/* While compiling, the rear light is first. */
celspan_status cs_lights_add_flat(cs_compiler *c, celspan_light light) {
  cs_stack *stack = &c->plan->stack;
  CS_TRY(CS_COMPILER_APPEND(c, lights, light_count));
  stack->lights[stack->light_count++] =
      (cs_back_light){(uint32_t)stack->layer_count, colour_of(light), 1 - light.a};
  return CELSPAN_OK;
}

/* A back light in the frame of an object: a layer that dims nothing. Its matte belongs to the
 * frame's layer. */
static celspan_status append_flat(cs_compiler *c, celspan_light light,
                                  const cs_compiler_film *film) {
  uint32_t index;
  if (light.r == 0 && light.g == 0 && light.b == 0)
    return CELSPAN_OK;
  CS_TRY(cs_layers_append(c, 1, CELSPAN_RULE_NONZERO, &index));
  cs_layer *layer = &c->plan->stack.layers[index];
  cs_layers_fill_flat(layer, CS_PAINT_CLEAR, 1);
  if (!c->fades_out)
    layer->s = under_shine(film, colour_of(light));
  return add_film_outline(c, film, index);
}

celspan_status cs_lights_add_back(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                  const cs_light *back, const cs_compiler_film *film) {
  const cs_light light = cs_scene_back(rostrum, back);
  const celspan_light flat = cs_light_in(&light, c->space);
  celspan_matrix inverse;
  bool found;
  uint32_t layer;
  if (!light.texture && film->outline)
    return append_flat(c, flat, film);
  if (!light.texture)
    return flat.r == 0 && flat.g == 0 && flat.b == 0 && flat.a == 0 ? CELSPAN_OK
                                                                    : cs_lights_add_flat(c, flat);
  CS_TRY(find_inverse(c, rostrum, index, &light, film, &inverse, &found));
  if (!found)
    return CELSPAN_OK;
  CS_TRY(append_shape(c, &light, film, &inverse, under_shine(film, grey(light.gain)), 1, &layer));
  cs_layer *added = &c->plan->stack.layers[layer];
  if (added->kind != CS_LAYER_FLAT) {
    added->role = CS_LAYER_BACK;
    added->t = grey(1); /* it dims nothing */
  }
  return add_film_outline(c, film, layer);
}

/* ---------------------------------------------------------------- front lights */

celspan_status cs_lights_set_front(cs_compiler *c, const celspan_rostrum *rostrum, size_t index,
                                   const cs_compiler_film *film, cs_lights_front *out) {
  bool found;
  *out = (cs_lights_front){.light = cs_scene_front(rostrum, rostrum->cels[index])};
  c->front = under_shine(film, colour_of(cs_light_in(&out->light, c->space)));
  if (!out->light.texture)
    return CELSPAN_OK;
  CS_TRY(find_inverse(c, rostrum, index, &out->light, film, &out->inverse, &found));
  out->is_shape = found && out->light.gain > 0;
  c->front = out->is_shape ? film->shine : cs_v4_all(0);
  return CELSPAN_OK;
}

celspan_status cs_lights_light_group(cs_compiler *c, const cs_lights_front *front,
                                     const cs_compiler_film *film) {
  cs_stack *stack = &c->plan->stack;
  uint32_t index;
  if (c->fades_out)
    return CELSPAN_OK;
  CS_TRY(append_shape(c, &front->light, film, &front->inverse, grey(front->light.gain), 1, &index));
  stack->layers[index].role = CS_LAYER_FRONT;
  stack->groups[c->group].light = index;
  stack->groups[c->group].has_light = true;
  stack->has_group_light = true;
  return CELSPAN_OK;
}
