/* Colours of other spaces than sRGB's codes, as CSS writes them: hwb(), lab(), lch(), oklab(),
 * oklch() and color().
 *
 * Colours outside of sRGB are clamped channel by channel.
 */
#pragma once

#include "celspan/celspan.h"

/* sRGB-coded, 0..1, alpha straight. */
typedef struct cs_svg_colour {
  double rgb[3], alpha;
} cs_svg_colour;

/* Reads such a colour at *text and moves *text behind it; false: there is none. */
bool cs_svg_take_space_colour(const char **text, cs_svg_colour *out);

/* The colour of a hue in degrees; alpha stays. */
void cs_svg_colour_of_hue(double hue, double saturation, double lightness, cs_svg_colour *out);
