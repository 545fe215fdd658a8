#include "readers/svg/text_style.h"

#include <string.h>

#include "base/number.h"

/* Source: CSS Fonts Module Level 4, 2.2: from 600 on a face that is bold is chosen. */
#define BOLD 600

static void read_weight(const char *text, bool *is_bold) {
  if (!text || cs_svg_is_word(text, "inherit"))
    return;
  cs_svg_length weight;
  if (cs_svg_is_word(text, "bold") || cs_svg_is_word(text, "bolder"))
    *is_bold = true;
  else if (cs_svg_parse_length(text, &weight))
    *is_bold = weight.value >= BOLD;
  else
    *is_bold = false;
}

static void read_slant(const char *text, bool *is_italic) {
  if (text && !cs_svg_is_word(text, "inherit"))
    *is_italic = cs_svg_is_word(text, "italic") || strncmp(text, "oblique", 7) == 0;
}

/* Per cents are of the em here, and so is what else there is to measure by. */
static void read_spacing(const char *text, double em, double *out) {
  const cs_svg_measure measure = {em, em, em, em, em, em};
  cs_svg_length length;
  if (!text || cs_svg_is_word(text, "inherit"))
    return;
  double resolved =
      cs_svg_parse_length(text, &length) ? cs_svg_resolve(length, CS_SVG_AXIS_X, &measure) : 0;
  *out = cs_number_is_sane(resolved) ? resolved : 0;
}

static void read_anchor(const char *text, cs_svg_anchor *out) {
  if (text && cs_svg_is_word(text, "start"))
    *out = CS_SVG_ANCHOR_START;
  else if (text && cs_svg_is_word(text, "middle"))
    *out = CS_SVG_ANCHOR_MIDDLE;
  else if (text && cs_svg_is_word(text, "end"))
    *out = CS_SVG_ANCHOR_END;
}

void cs_svg_text_style_read(const cs_svg_node *node, const char *const *values, double em,
                            cs_svg_text_style *out) {
  const char *family = values[CS_SVG_FONT_FAMILY], *direction = values[CS_SVG_DIRECTION];
  const char *space = cs_svg_node_value(node, CS_SVG_SPACE);
  if (family && !cs_svg_is_word(family, "inherit"))
    out->font_family = family;
  read_weight(values[CS_SVG_FONT_WEIGHT], &out->is_bold);
  read_slant(values[CS_SVG_FONT_STYLE], &out->is_italic);
  read_spacing(values[CS_SVG_LETTER_SPACING], em, &out->letter_spacing);
  read_spacing(values[CS_SVG_WORD_SPACING], em, &out->word_spacing);
  read_anchor(values[CS_SVG_TEXT_ANCHOR], &out->anchor);
  if (direction && !cs_svg_is_word(direction, "inherit"))
    out->is_leftward = cs_svg_is_word(direction, "rtl");
  if (space)
    out->is_preserved = cs_svg_is_word(space, "preserve");
}
