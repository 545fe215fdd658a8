#include "readers/svg/text_style.h"

#include <string.h>

#include "base/number.h"

/* Source: CSS Fonts Module Level 4, 2.2: from 600 on a face that is bold is chosen. */
#define BOLD 600

static void read_weight(const char *text, bool *is_bold) {
  if (!text)
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
  if (text)
    *is_italic = cs_svg_is_word(text, "italic") || strncmp(text, "oblique", 7) == 0;
}

/* Per cents, and all other relative lengths, refer to the em here. */
static void read_spacing(const char *text, double em, double *out) {
  const cs_svg_measure measure = {em, em, em, em, em, em};
  cs_svg_length length;
  if (!text)
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

/* False for a word that says no line. */
static bool read_baseline(const char *text, cs_svg_baseline *out) {
  static const struct {
    const char *words;
    cs_svg_baseline line;
  } lines[] = {
      {"alphabetic", CS_SVG_BASELINE_ALPHABETIC},
      {"middle", CS_SVG_BASELINE_MIDDLE},
      {"central|center", CS_SVG_BASELINE_CENTRAL},
      {"hanging", CS_SVG_BASELINE_HANGING},
      {"mathematical", CS_SVG_BASELINE_MATHEMATICAL},
      {"ideographic|text-bottom|text-after-edge|after-edge|bottom", CS_SVG_BASELINE_BOTTOM},
      {"text-top|text-before-edge|before-edge|top", CS_SVG_BASELINE_TOP}};
  for (size_t i = 0; text && i < sizeof lines / sizeof *lines; i++)
    if (cs_svg_words_have(lines[i].words, text)) {
      *out = lines[i].line;
      return true;
    }
  return false;
}

static void read_baselines(const char *const *values, cs_svg_text_style *out) {
  const char *dominant = values[CS_SVG_DOMINANT_BASELINE];
  if (dominant && !read_baseline(dominant, &out->dominant) &&
      !cs_svg_is_word(dominant, "no-change"))
    out->dominant = CS_SVG_BASELINE_ALPHABETIC;
  if (!read_baseline(values[CS_SVG_ALIGNMENT_BASELINE], &out->own))
    out->own = out->dominant;
}

/* Shifts add up from a text inwards. Source of the shares: CSS Inline Layout Module Level 3, 4.2.3.
 */
static void read_shift(const cs_svg_node *node, const char *text, double em, double parent_em,
                       double *out) {
  const cs_svg_measure measure = {em, em, em, em, em, em};
  cs_svg_length length;
  if (node->element != CS_SVG_ELEMENT_TSPAN && node->element != CS_SVG_ELEMENT_TEXT_PATH &&
      node->element != CS_SVG_ELEMENT_A)
    *out = 0;
  else if (text && cs_svg_is_word(text, "super"))
    *out += parent_em / 3;
  else if (text && cs_svg_is_word(text, "sub"))
    *out -= parent_em / 5;
  else if (text && cs_svg_parse_length(text, &length))
    *out += cs_svg_resolve(length, CS_SVG_AXIS_X, &measure);
}

void cs_svg_text_style_read(const cs_svg_node *node, const char *const *values, double em,
                            double parent_em, cs_svg_text_style *out) {
  const char *family = values[CS_SVG_FONT_FAMILY], *direction = values[CS_SVG_DIRECTION];
  const char *space = cs_svg_node_value(node, CS_SVG_SPACE);
  if (family)
    out->font_family = family;
  read_weight(values[CS_SVG_FONT_WEIGHT], &out->is_bold);
  read_slant(values[CS_SVG_FONT_STYLE], &out->is_italic);
  read_spacing(values[CS_SVG_LETTER_SPACING], em, &out->letter_spacing);
  read_spacing(values[CS_SVG_WORD_SPACING], em, &out->word_spacing);
  read_anchor(values[CS_SVG_TEXT_ANCHOR], &out->anchor);
  read_baselines(values, out);
  read_shift(node, values[CS_SVG_BASELINE_SHIFT], em, parent_em, &out->raised);
  if (direction)
    out->is_leftward = cs_svg_is_word(direction, "rtl");
  if (space)
    out->is_preserved = cs_svg_is_word(space, "preserve");
}
