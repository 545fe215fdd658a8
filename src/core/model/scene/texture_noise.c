/* Textures of noise: what they are made of, checked. */
#include "base/description.h"
#include "model/scene/check.h"
#include "model/scene/texture.h"

#define NOUN "noise"

static bool has_octaves(celspan_noise_kind kind) {
  return kind == CELSPAN_NOISE_FRACTAL || kind == CELSPAN_NOISE_TURBULENCE;
}

static celspan_status check(celspan_context *context, const celspan_noise_desc *desc) {
  CS_TRY(cs_check_choice(context, NOUN, "kind", (unsigned)desc->kind, CELSPAN_NOISE_WHITE + 1));
  CS_TRY(cs_check_positive(context, NOUN, "size", desc->size));
  CS_TRY(cs_check_range(context, NOUN, "octaves", desc->octaves, 1, CS_NOISE_OCTAVES));
  CS_TRY(cs_check_range(context, NOUN, "gain", desc->gain, 0, 1));
  return cs_check_number(context, NOUN, "at", desc->at);
}

celspan_status celspan_texture_create_noise(celspan_context *context,
                                            const celspan_noise_desc *desc, celspan_texture **out) {
  const celspan_stop greys[] = {{0, celspan_paint_rgb(0, 0, 0, 1)},
                                {1, celspan_paint_rgb(1, 1, 1, 1)}};
  CS_READ(context, NOUN, celspan_noise_desc, desc);
  CS_TRY(check(context, desc));
  bool is_grey = desc->stop_count == 0;
  celspan_texture *texture = NULL;
  CS_TRY(cs_texture_create_stops(context, NOUN, CS_TEXTURE_NOISE, is_grey ? greys : desc->stops,
                                 is_grey ? 2 : desc->stop_count, false, &texture));
  if (texture->kind == CS_TEXTURE_NOISE)
    cs_texture_own(texture)->noise = (cs_noise){
        desc->kind, desc->size, has_octaves(desc->kind) ? desc->octaves : 1, desc->gain, desc->seed,
        desc->at,   desc->fades};
  cs_texture_rehash(texture);
  *out = texture;
  return CELSPAN_OK;
}
