/* The hash of a frame's contents, and whether it has one. */
#include "model/scene/scene.h"

#include "base/number.h"
#include "model/scene/check.h"
#include "model/scene/texture_unroll.h"
#include "model/scene/value.h"

static bool has_procedure(const celspan_cel *cel) {
  for (size_t i = 0; i < cel->object_count; i++)
    if (cel->objects[i]->data->has_procedure)
      return true;
  return false;
}

bool cs_scene_has_procedure(const celspan_exposure *exposures, size_t count) {
  for (size_t i = 0; i < count; i++)
    for (size_t k = 0; k < exposures[i].rostrum->cel_count; k++)
      if (has_procedure(exposures[i].rostrum->cels[k]))
        return true;
  return false;
}

cs_hash cs_scene_hash(const celspan_exposure *exposures, size_t count) {
  cs_hash hash = cs_hash_begin(count);
  for (size_t i = 0; i < count; i++) {
    cs_hash_hash(&hash, exposures[i].rostrum->hash);
    cs_hash_number(&hash, exposures[i].weight);
  }
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- lights */

static celspan_status check(celspan_context *context, const cs_light_desc *desc) {
  const celspan_light_texture *shape = desc->texture;
  if (!shape->texture)
    return cs_check_light(context, desc->noun, desc->field, &desc->flat);
  CS_TRY(cs_check_item(context, (cs_check_field){desc->noun, desc->field, 0, "gain"}, shape->gain,
                       0, CS_NUMBER_LIMIT));
  CS_TRY(cs_check_item(context, (cs_check_field){desc->noun, desc->field, 0, "matte"}, shape->matte,
                       0, 1));
  return cs_check_item(context, (cs_check_field){desc->noun, desc->field, 0, "on"}, shape->on, 0,
                       CELSPAN_LIGHT_ON_CEL);
}

/* The colour of a texture of one paint in a space. */
static celspan_light flat_of(const celspan_texture *texture, const celspan_light_texture *shape,
                             celspan_space space) {
  const cs_paint paint = cs_space_paint(space, texture->flat);
  return (celspan_light){
      (float)(shape->gain * (double)paint.s[0]), (float)(shape->gain * (double)paint.s[1]),
      (float)(shape->gain * (double)paint.s[2]), (float)(shape->matte * (double)paint.beta)};
}

celspan_status cs_light_make(celspan_context *context, const cs_light_desc *desc, cs_light *out) {
  CS_TRY(check(context, desc));
  const celspan_light_texture *shape = desc->texture;
  if (!shape->texture) {
    celspan_space space = desc->is_colour ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR;
    *out = (cs_light){
        .is_given = desc->is_given, .flat = desc->flat, .coded = cs_space_light(space, desc->flat)};
    return CELSPAN_OK;
  }
  celspan_texture *texture;
  if (shape->texture->kind == CS_TEXTURE_PATTERN)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: %s is a pattern, which is no light; light the art with a picture or a "
                   "gradient instead",
                   desc->noun, desc->field);
  CS_TRY(cs_texture_create_light(context, shape->texture, &texture));
  celspan_status status = cs_texture_unroll(context, &texture, NULL);
  if (status != CELSPAN_OK) {
    celspan_texture_unref(texture);
    return status;
  }
  *out = (cs_light){.is_given = true,
                    .texture = texture,
                    .gain = shape->gain,
                    .on = shape->on,
                    .matte = shape->matte};
  if (texture->kind != CS_TEXTURE_FLAT)
    return CELSPAN_OK;
  *out = (cs_light){.is_given = true,
                    .flat = flat_of(texture, shape, CELSPAN_SPACE_LINEAR),
                    .coded = flat_of(texture, shape, CELSPAN_SPACE_SRGB)};
  celspan_texture_unref(texture);
  return CELSPAN_OK;
}

cs_light cs_light_ref(const cs_light *light) {
  if (light->texture)
    celspan_texture_ref(light->texture);
  return *light;
}

void cs_light_unref(const cs_light *light) { celspan_texture_unref(light->texture); }

void cs_light_hash(cs_hash *hash, const cs_light *light) {
  cs_value_hash_light(hash, &light->flat);
  cs_value_hash_light(hash, &light->coded);
  if (!light->texture)
    return;
  cs_hash_hash(hash, light->texture->hash);
  cs_hash_number(hash, light->gain);
  cs_hash_word(hash, light->on);
  cs_hash_number(hash, light->matte);
}

static celspan_light scale(celspan_light light, float by) {
  return (celspan_light){light.r * by, light.g * by, light.b * by, light.a};
}

cs_light cs_light_scale(const cs_light *light, double brightness) {
  cs_light scaled = *light;
  scaled.flat = scale(light->flat, (float)brightness);
  scaled.coded = scale(light->coded, (float)brightness);
  scaled.gain = light->gain * brightness;
  return scaled;
}

/* ---------------------------------------------------------------- one light alone */

static cs_light light_of(float x) {
  return (cs_light){.is_given = true, .flat = {x, x, x, 0}, .coded = {x, x, x, 0}};
}

celspan_status cs_lit_alone_make(celspan_context *context, const celspan_rostrum *rostrum,
                                 size_t index, bool is_back, cs_lit_alone *out) {
  size_t count = rostrum->cel_count - index;
  if (cs_rostrum_has_modes(rostrum) || rostrum->grade || rostrum->grain)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "rostrum: it or a cel has a blend mode, a grade or grain, so its lights do not "
                   "add up and cannot be taken apart");
  cs_lit_alone alone = {.count = count};
  cs_value_copy(&alone.rostrum, rostrum, sizeof *rostrum);
  alone.cels = cs_mem_array(context->memory, count, sizeof *alone.cels);
  alone.rostrum.cels = cs_mem_array(context->memory, count, sizeof *alone.rostrum.cels);
  if (count > 0 && (!alone.cels || !alone.rostrum.cels)) {
    cs_lit_alone_finish(context, &alone);
    return cs_fail_memory(context);
  }
  for (size_t i = 0; i < count; i++) {
    cs_value_copy(&alone.cels[i], rostrum->cels[index + i], sizeof *alone.cels);
    alone.cels[i].front = light_of(i == 0 && !is_back ? 1 : 0);
    alone.cels[i].back = light_of(0);
    alone.rostrum.cels[i] = &alone.cels[i];
  }
  /* Behind the rearmost cel that is left, the back light of the rostrum takes the place of the
   * cel's own back light. */
  alone.rostrum.back = light_of(is_back ? 1 : 0);
  alone.rostrum.cel_count = count;
  alone.rostrum.brightness = 1;
  *out = alone;
  return CELSPAN_OK;
}

void cs_lit_alone_finish(celspan_context *context, cs_lit_alone *alone) {
  cs_mem_free(context->memory, alone->cels, alone->count * sizeof *alone->cels);
  cs_mem_free(context->memory, alone->rostrum.cels, alone->count * sizeof *alone->rostrum.cels);
  alone->cels = NULL;
  alone->rostrum.cels = NULL;
}
