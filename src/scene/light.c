#include "scene/light.h"

#include "base/number.h"
#include "scene/check.h"
#include "scene/texture.h"
#include "scene/unroll.h"
#include "scene/value.h"

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

/* What a texture of one paint shines with. */
static celspan_light flat_of(const celspan_texture *texture, const celspan_light_texture *shape) {
  const cs_paint *paint = &texture->flat;
  return (celspan_light){
      (float)(shape->gain * (double)paint->s[0]), (float)(shape->gain * (double)paint->s[1]),
      (float)(shape->gain * (double)paint->s[2]), (float)(shape->matte * (double)paint->beta)};
}

celspan_status cs_light_make(celspan_context *context, const cs_light_desc *desc, cs_light *out) {
  CS_TRY(check(context, desc));
  const celspan_light_texture *shape = desc->texture;
  if (!shape->texture) {
    *out = (cs_light){.is_given = desc->is_given, .flat = desc->flat};
    return CELSPAN_OK;
  }
  celspan_texture *texture;
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
  *out = (cs_light){.is_given = true, .flat = flat_of(texture, shape)};
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
  if (!light->texture)
    return;
  cs_hash_hash(hash, light->texture->hash);
  cs_hash_number(hash, light->gain);
  cs_hash_word(hash, light->on);
  cs_hash_number(hash, light->matte);
}

cs_light cs_light_scale(const cs_light *light, double brightness) {
  float scale = (float)brightness;
  cs_light scaled = *light;
  scaled.flat = (celspan_light){light->flat.r * scale, light->flat.g * scale, light->flat.b * scale,
                                light->flat.a};
  scaled.gain = light->gain * brightness;
  return scaled;
}
