#include "model/colour/blend.h"

#include "model/colour/blend_lanes.h"

const char *const cs_blend_words[] = {"normal",
                                      "multiply",
                                      "screen",
                                      "overlay",
                                      "darken",
                                      "lighten",
                                      "color-dodge",
                                      "color-burn",
                                      "hard-light",
                                      "soft-light",
                                      "difference",
                                      "exclusion",
                                      "hue",
                                      "saturation",
                                      "color",
                                      "luminosity",
                                      "add",
                                      "linear-dodge",
                                      "soft-light-photoshop",
                                      "linear-burn",
                                      "vivid-light",
                                      "linear-light",
                                      "pin-light",
                                      "hard-mix",
                                      "subtract",
                                      "divide",
                                      "darker-color",
                                      "lighter-color",
                                      NULL};

static inline cs_wide one_colour(cs_v4 colour) {
  cs_wide lanes = cs_wide_all(0);
  memcpy(&lanes, &colour, sizeof colour);
  return lanes;
}

cs_v4 cs_blend_colour(celspan_blend mode, cs_v4 b, cs_v4 s) {
  const cs_wide lanes = cs_blend_lanes(mode, one_colour(b), one_colour(s));
  cs_v4 colour;
  memcpy(&colour, &lanes, sizeof colour);
  return colour;
}
