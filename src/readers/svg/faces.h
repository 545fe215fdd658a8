/* The fonts of a text: from the caller's fonts, first the fonts that font-family names, then the
 * font for all families.
 *
 *   font-family: Arial, "Gill Sans"; font-weight: bold
 *   tried: "Arial Bold", "Arial", "Gill Sans Bold", "Gill Sans", "default"
 */
#pragma once

#include "readers/svg/reading.h"
#include "readers/text/layout.h"

typedef struct cs_svg_faces {
  const char *fonts[CS_TEXT_FONTS]; /* borrowed from the source; each is used for letters that the
                                       fonts before it lack */
  size_t count;                     /* 0: none was given */
  bool is_plain;                    /* the first is bold or italic less than it should be */
} cs_svg_faces;

void cs_svg_faces_find(const cs_svg_source *source, const cs_svg_style *style, cs_svg_faces *out);
/* Whether two styles have the same fonts, of one size and spacing. */
bool cs_svg_faces_are_same(const cs_svg_style *a, const cs_svg_style *b);
