#include "model/colour/space.h"

#include "model/colour/transfer.h"

const char *const cs_space_words[] = {"linear", "srgb", NULL};

static float convert(celspan_space to, float colour) {
  return to == CELSPAN_SPACE_SRGB ? cs_transfer_encode(CELSPAN_TRANSFER_SRGB, colour)
                                  : cs_transfer_decode(CELSPAN_TRANSFER_SRGB, colour);
}

float cs_space_channel(celspan_space to, float s, float share) {
  float there = cs_space_there(s, share);
  return there > 0 ? there * convert(to, s / there) : s;
}

static void convert_colour(celspan_space to, float rgba[4]) {
  for (int c = 0; c < 3; c++)
    rgba[c] = cs_space_channel(to, rgba[c], rgba[3]);
}

void cs_space_encode(celspan_space to, float rgba[4]) {
  if (to == CELSPAN_SPACE_SRGB)
    convert_colour(CELSPAN_SPACE_SRGB, rgba);
}

void cs_space_decode(celspan_space from, float rgba[4]) {
  if (from == CELSPAN_SPACE_SRGB)
    convert_colour(CELSPAN_SPACE_LINEAR, rgba);
}

cs_paint cs_space_paint(celspan_space space, cs_paint paint) {
  for (int c = 0; c < 3 && space == CELSPAN_SPACE_SRGB; c++)
    paint.s[c] = cs_space_channel(space, paint.s[c], paint.beta);
  return paint;
}

celspan_light cs_space_light(celspan_space space, celspan_light light) {
  if (space != CELSPAN_SPACE_SRGB)
    return light;
  return (celspan_light){convert(space, light.r), convert(space, light.g), convert(space, light.b),
                         light.a};
}
