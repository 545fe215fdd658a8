/* Keys of a row of pixels, a register at a time: as cs_over_develop, to the bit. Colours are
 * converted for all pixels at once. */
#include "engine/paint/over_row.h"
#include "engine/paint/over_wide.h"
#include "model/colour/keying_lanes.h"

static inline cs_wide there_at(const cs_over_row_state *state, int32_t i) {
  const cs_wide alpha = 1 - cs_over_wide_mean(cs_wide_load(state->t[i]));
  return cs_keying_lanes_there(cs_wide_load(state->e[i]), alpha);
}

/* A row of colours: each is whole, so that a conversion does not depend on an alpha. */
static void convert(celspan_space from, celspan_space to, int32_t count, float (*colours)[4]) {
  float whole[CS_OVER_ROW_BATCH][4] = {{0}};
  if (from == to)
    return;
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(whole[i], cs_wide_all(1));
  CS_WIDE(cs_space_pixels)(to, whole[0], count, colours[0]);
}

/* Takes the spill off; false where no pixel has any. */
static bool clean(const cs_keying *key, int32_t count, float (*codes)[4], float (*spills)[4]) {
  const cs_wide screen = cs_wide_pixel(key->screen);
  bool has_any = false;
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    const cs_wide colour = cs_wide_load(codes[i]), spill = cs_keying_lanes_spill(key, colour);
    has_any |= cs_wide_any(spill > 0);
    cs_wide_store(spills[i], spill);
    cs_wide_store(codes[i], cs_keying_lanes_clean(screen, spill, colour));
  }
  return has_any;
}

void CS_WIDE(cs_over_row_key)(cs_over_row_state *state, int32_t count, const cs_keying *key,
                              celspan_space space) {
  const cs_wide_int rgb = CS_WIDE_PIXEL(-1, -1, -1, 0);
  float colours[CS_OVER_ROW_BATCH][4], stays[CS_OVER_ROW_BATCH][4], spills[CS_OVER_ROW_BATCH][4];
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    const cs_wide e = (cs_wide)((cs_wide_int)cs_wide_load(state->e[i]) & rgb);
    cs_wide_store(colours[i], cs_keying_lanes_straight(e, there_at(state, i)));
  }
  cs_over_wide_clear_rest(colours, count);
  convert(space, CELSPAN_SPACE_SRGB, count, colours);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS)
    cs_wide_store(stays[i], cs_keying_lanes_stays(key, cs_wide_load(colours[i])));
  const bool has_spill = key->spill > 0 && clean(key, count, colours, spills);
  if (has_spill)
    convert(CELSPAN_SPACE_SRGB, space, count, colours);
  for (int32_t i = 0; i < count; i += CS_OVER_WIDE_PIXELS) {
    cs_wide e = cs_wide_load(state->e[i]), stay = cs_wide_load(stays[i]);
    if (has_spill)
      e = cs_wide_choose(cs_wide_load(spills[i]) > 0, there_at(state, i) * cs_wide_load(colours[i]),
                         e);
    cs_wide_store(state->e[i], stay * e);
    cs_wide_store(state->t[i], (1 - stay) + stay * cs_wide_load(state->t[i]));
  }
}
