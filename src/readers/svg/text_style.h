/* The properties of texts: fonts, spacing, anchor, direction. All are inherited except `own`. */
#pragma once

#include "readers/svg/document.h"
#include "readers/svg/values.h"

/* Which part of a text lies at its position. In a text that runs to the right, the start is on the
 * left. */
typedef enum cs_svg_anchor {
  CS_SVG_ANCHOR_START,
  CS_SVG_ANCHOR_MIDDLE,
  CS_SVG_ANCHOR_END
} cs_svg_anchor;

/* The line of a letter that lies at its place. */
typedef enum cs_svg_baseline {
  CS_SVG_BASELINE_ALPHABETIC,
  CS_SVG_BASELINE_MIDDLE,
  CS_SVG_BASELINE_CENTRAL,
  CS_SVG_BASELINE_HANGING,
  CS_SVG_BASELINE_MATHEMATICAL,
  CS_SVG_BASELINE_BOTTOM,
  CS_SVG_BASELINE_TOP
} cs_svg_baseline;

typedef struct cs_svg_text_style {
  const char *font_family; /* a list, as written; NULL: none */
  bool is_italic, is_bold;
  double letter_spacing, word_spacing; /* user units */
  cs_svg_anchor anchor;
  cs_svg_baseline dominant, own; /* own: the value of the element alone */
  double raised;                 /* by baseline-shift, user units, including the shifts of the
                                    elements around it */
  bool is_leftward;              /* the direction of texts */
  bool is_preserved;             /* every space of a text counts */
} cs_svg_text_style;

/* Reads the properties of texts from `values`, the winning values by name. em, parent_em: the font
 * size of the element and of its parent, in user units. *out contains the inherited style. */
void cs_svg_text_style_read(const cs_svg_node *node, const char *const *values, double em,
                            double parent_em, cs_svg_text_style *out);
