/* Colours as SVG and CSS write them: sRGB-coded, 0..1, alpha straight. */
#pragma once

#include "readers/svg/colour_spaces.h"

/* "#rgb", "#rrggbb" and with alpha, rgb(), rgba(), hsl(), hsla(), those of colour_spaces.h, a name,
 * transparent: reads the colour at *text and moves *text behind it. False when there is no
 * colour. */
bool cs_svg_take_colour(const char **text, cs_svg_colour *out);
