/* The reasons are those of the fold (engine/compose/over.h): a layer over another one is
 * e + t * e', with the same t for the three channels, and nothing is done to the result. */
#include <stdio.h>

#include "frames/apart/apart.h"
#include "model/scene/texture.h"
#include "model/scene/walk.h"

static bool is_gel(const celspan_texture *texture) {
  return texture && !cs_texture_is_grey(texture);
}

static celspan_status find_gel(const cs_walk *walk, const cs_primitive_data *primitive,
                               const celspan_texture *texture) {
  *(bool *)walk->user |= primitive && is_gel(texture);
  return CELSPAN_OK;
}

static bool has_gel(const celspan_cel *cel) {
  bool is_found = false;
  cs_walk walk = {.call = find_gel, .user = &is_found};
  celspan_status never_fails = cs_walk_cel(&walk, cel);
  (void)never_fails;
  return is_found;
}

/* The matte of a back light makes the picture opaque, but does not dim the cels behind it. */
static bool has_matte(const cs_light *back) {
  return back->texture ? back->matte > 0 : back->flat.a > 0;
}

/* NULL: the layer of the cel over the layers behind it shows the same as the frame. */
static const char *reason_of(const celspan_cel *cel, celspan_space space) {
  return cs_cel_blends(cel, space) ? "has a blend mode"
         : has_gel(cel)            ? "has a gel, which colours the light from behind"
         : has_matte(&cel->back)   ? "has a back light with a matte"
                                   : NULL;
}

static bool cels_sum(const celspan_rostrum *rostrum, celspan_space space, char *why) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const char *reason = reason_of(rostrum->cels[i], space);
    if (!reason)
      continue;
    cs_mark_text mark = cs_mark_describe(rostrum->cels[i]->mark);
    snprintf(why, CS_APART_WHY, "cel %zu%s %s", i + 1, mark.text, reason);
    return false;
  }
  return true;
}

bool cs_apart_sums(const celspan_exposure *exposures, size_t count, celspan_space film_space,
                   char why[CS_APART_WHY]) {
  if (count != 1 || exposures->weight != 1) {
    snprintf(why, CS_APART_WHY, "it has several exposures, or one that is not whole");
    return false;
  }
  const celspan_rostrum *rostrum = exposures->rostrum;
  celspan_space space = cs_space_inside(rostrum->space, film_space);
  if (space == CELSPAN_SPACE_SRGB || film_space == CELSPAN_SPACE_SRGB) {
    snprintf(why, CS_APART_WHY, "it mixes codes (space \"srgb\"), and layers are linear light");
    return false;
  }
  if (rostrum->grade) {
    snprintf(why, CS_APART_WHY, "its rostrum has a grade, which each layer has for itself");
    return false;
  }
  return cels_sum(rostrum, space, why);
}
