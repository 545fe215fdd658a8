/* The reasons lie in the fold (engine/compose/over.h): a layer over another one is
 * e + t * e', with the same t for the three channels, and nothing is done to the result. */
#include <math.h>
#include <stdio.h>

#include "inside/colour.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"

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

static bool has_mode(const cs_apart_format *format, celspan_blend blend) {
  return format->has_mode && format->has_mode(blend);
}

static const char *blend_reason(const celspan_cel *cel, const cs_apart_format *format,
                                celspan_space space) {
  if (!cs_cel_blends(cel, space))
    return NULL;
  if (cel->blend == CELSPAN_BLEND_NORMAL)
    return "has an object with a blend mode";
  return has_mode(format, CS_BLEND_MODE(cel->blend))
             ? NULL
             : "has a blend mode that such files do not have";
}

static const char *back_reason(const cs_light *back, const cs_apart_format *format) {
  bool has_light = back->texture || back->flat.r > 0 || back->flat.g > 0 || back->flat.b > 0;
  if (has_matte(back))
    return "has a back light with a matte";
  return has_light && !format->is_light
             ? "has a back light without a matte, which such files lack where alpha is 0"
             : NULL;
}

/* NULL: the layer of the cel over the layers behind it shows the same as the frame. */
static const char *reason_of(const celspan_cel *cel, const cs_apart_format *format,
                             celspan_space space) {
  const char *blends = blend_reason(cel, format, space);
  if (blends)
    return blends;
  return has_gel(cel) ? "has a gel, which colours the light from behind"
                      : back_reason(&cel->back, format);
}

/* Writes what prevents it. index: of a cel, from 1. */
static bool refuse_cel(const celspan_rostrum *rostrum, size_t index, const char *reason,
                       char *why) {
  cs_mark_text mark = cs_mark_describe(rostrum->cels[index - 1]->mark);
  snprintf(why, CS_APART_WHY, "cel %zu%s %s", index, mark.text, reason);
  return false;
}

static bool cels_sum(const celspan_rostrum *rostrum, const cs_apart_format *format,
                     celspan_space space, char *why) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const char *reason = reason_of(rostrum->cels[i], format, space);
    if (reason)
      return refuse_cel(rostrum, i + 1, reason, why);
  }
  return true;
}

/* The only exposure that is in the frame, if it is whole; else NULL. */
static const celspan_exposure *find_whole(const celspan_exposure *exposures, size_t count) {
  const celspan_exposure *found = NULL;
  for (size_t i = 0; i < count; i++) {
    if (!cs_apart_shows(&exposures[i]))
      continue;
    if (found || exposures[i].weight != 1)
      return NULL;
    found = &exposures[i];
  }
  return found;
}

static bool shows_nothing(const celspan_exposure *exposures, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (cs_apart_shows(&exposures[i]))
      return false;
  return true;
}

/* Layers of light are mixed as light, and layers of codes as codes. coding: of the pixels. NULL: as
 * the film mixes. */
static const char *mixing_of(const cs_apart_format *format, const celspan_coding *coding,
                             celspan_space space, celspan_space film_space) {
  celspan_coding whole = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  bool is_light = space != CELSPAN_SPACE_SRGB && film_space != CELSPAN_SPACE_SRGB;
  bool is_code = space == CELSPAN_SPACE_SRGB && film_space == CELSPAN_SPACE_SRGB;
  bool is_linear = format->is_light || whole.transfer == CELSPAN_TRANSFER_LINEAR;
  if (!is_linear && whole.transfer != CELSPAN_TRANSFER_SRGB)
    return "--colour or --display converts each layer by itself, and films mix light or the codes "
           "of sRGB";
  if (is_linear)
    return is_light ? NULL : "it mixes codes (space \"srgb\"), and layers are linear light";
  return is_code ? NULL
                 : "it mixes light, and programs mix the codes of such layers, as a film does with "
                   "space = \"srgb\"";
}

static bool is_brighter(const cs_light *light, celspan_space space, double by, double than) {
  const celspan_light flat = space == CELSPAN_SPACE_SRGB ? light->coded : light->flat;
  return fmax(flat.r, fmax(flat.g, flat.b)) * by > than * 1.0001;
}

/* Whether no light is cut in a layer, where such files end at white, that another one dims. */
static bool lights_sum(const celspan_rostrum *rostrum, celspan_space space, char *why) {
  const cs_light *back = &rostrum->back;
  if (rostrum->cel_count > 0 && !back->texture &&
      is_brighter(back, space, rostrum->brightness, back->flat.a)) {
    snprintf(why, CS_APART_WHY, "its back light is brighter than its matte, which such files cut");
    return false;
  }
  for (size_t i = 1; i < rostrum->cel_count; i++) {
    const cs_light front = cs_scene_front(rostrum, rostrum->cels[i - 1]);
    if (is_brighter(&front, space, 1, 1))
      return refuse_cel(rostrum, i, "is lit by more than 1, and such files end at white", why);
  }
  return true;
}

/* Whether a kernel takes away: what it makes of the frame, or of a layer, stays within the colours
 * that are there. */
static bool is_signed(const cs_antialias *antialias) {
  bool is = false;
  for (int i = 0; i < CS_ANTIALIAS_SAMPLES && antialias->mode == CELSPAN_ANTIALIAS_FILTER; i++)
    is |= antialias->samples[i] < 0;
  return is;
}

bool cs_apart_sums(const celspan_exposure *exposures, size_t count, const cs_apart_format *format,
                   const celspan_coding *coding, celspan_space film_space, char why[CS_APART_WHY]) {
  const celspan_exposure *whole = find_whole(exposures, count);
  if (!whole && shows_nothing(exposures, count))
    return true;
  if (!whole) {
    snprintf(why, CS_APART_WHY, "it has several exposures, or one that is not whole");
    return false;
  }
  const celspan_rostrum *rostrum = whole->rostrum;
  celspan_space space = cs_space_inside(rostrum->space, film_space);
  const char *mixing = mixing_of(format, coding, space, film_space);
  if (mixing) {
    snprintf(why, CS_APART_WHY, "%s", mixing);
    return false;
  }
  if (rostrum->grade || rostrum->grain) {
    snprintf(why, CS_APART_WHY, "its rostrum has %s, which each layer has for itself",
             rostrum->grade ? "a grade" : "grain");
    return false;
  }
  if (rostrum->cel_count > 0 && is_signed(&rostrum->antialias)) {
    snprintf(why, CS_APART_WHY,
             "the kernel of its antialiasing is negative somewhere, and colours "
             "stay within those around them, in each layer for itself");
    return false;
  }
  return cels_sum(rostrum, format, space, why) &&
         (format->is_light || lights_sum(rostrum, space, why));
}
