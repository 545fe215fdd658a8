/* Colours as SVG and CSS write them: sRGB-coded, 0..1, alpha straight. */
#pragma once

#include "celspan/celspan.h"

/* sRGB-coded, 0..1, alpha straight. */
typedef struct cs_svg_colour {
  double rgb[3], alpha;
} cs_svg_colour;

/* "#rgb", "#rrggbb" and with alpha, rgb(), rgba(), hsl(), hsla(), hwb(), lab(), lch(), oklab(),
 * oklch(), color(), a name, transparent: reads the colour at *text and moves *text to its end.
 * False if there is no colour. */
bool cs_svg_take_colour(const char **text, cs_svg_colour *out);
/* The same for hwb() to color() only: colours of other spaces. Colours outside of sRGB are clamped
 * channel by channel. */
bool cs_svg_take_space_colour(const char **text, cs_svg_colour *out);

/* The names of colours, sorted. */
const char *const *cs_svg_colour_names(size_t *count);

/* The colour of a hue in degrees; its alpha does not change. */
void cs_svg_colour_of_hue(double hue, double saturation, double lightness, cs_svg_colour *out);
