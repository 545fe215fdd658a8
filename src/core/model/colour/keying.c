#include "model/colour/keying.h"

#include <math.h>

/* Cb and Cr. */
static void chroma_of(const double codes[3], double chroma[2]) {
  const double luma = CS_LUMA(double, codes[0], codes[1], codes[2]);
  chroma[0] = (codes[2] - luma) / 1.8556;
  chroma[1] = (codes[0] - luma) / 1.5748;
}

double cs_keying_hue(const double codes[3]) {
  double chroma[2];
  chroma_of(codes, chroma);
  return sqrt(chroma[0] * chroma[0] + chroma[1] * chroma[1]);
}

cs_keying cs_keying_of_chroma(const double codes[3], double tolerance, double softness,
                              double spill) {
  cs_keying key = {.is_given = true, .from = (float)tolerance, .spill = (float)spill};
  double chroma[2], size = cs_keying_hue(codes);
  chroma_of(codes, chroma);
  for (int i = 0; i < 2; i++) {
    key.chroma[i] = (float)chroma[i];
    key.along[i] = (float)(chroma[i] / (size * size));
  }
  for (int c = 0; c < 3; c++)
    key.screen[c] = (float)codes[c];
  key.gain = (float)(1 / fmax(softness, CS_KEYING_NARROWEST));
  return key;
}

cs_keying cs_keying_of_luma(double from, double to) {
  const double width = copysign(fmax(fabs(to - from), CS_KEYING_NARROWEST), to - from);
  return (cs_keying){
      .is_given = true, .is_luma = true, .from = (float)from, .gain = (float)(1 / width)};
}

/* ---------------------------------------------------------------- one colour */

static cs_wide one_colour(cs_v4 colour) {
  cs_wide lanes = cs_wide_all(0);
  colour[3] = 0;
  memcpy(&lanes, &colour, sizeof colour);
  return lanes;
}

static cs_wide convert(celspan_space from, celspan_space to, cs_wide colour) {
  for (int c = 0; c < 3 && from != to; c++)
    colour[c] = cs_space_channel(to, colour[c], 1);
  return colour;
}

float cs_keying_light(const cs_keying *key, celspan_space space, float alpha, cs_v4 *light) {
  const cs_wide e = one_colour(*light), there = cs_keying_lanes_there(e, cs_wide_all(alpha));
  const cs_wide codes = convert(space, CELSPAN_SPACE_SRGB, cs_keying_lanes_straight(e, there));
  const cs_wide spill = cs_keying_lanes_spill(key, codes),
                stays = cs_keying_lanes_stays(key, codes);
  if (spill[0] > 0) {
    const cs_wide screen = one_colour(cs_v4_load(key->screen));
    const cs_wide clean =
        convert(CELSPAN_SPACE_SRGB, space, cs_keying_lanes_clean(screen, spill, codes));
    const cs_wide lit = there * clean;
    memcpy(light, &lit, sizeof *light);
  }
  return stays[0];
}
