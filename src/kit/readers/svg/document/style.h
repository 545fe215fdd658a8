/* The style of an element: its properties, computed from the values that win (cascade.h) and from
 * inherited values. */
#pragma once

#include "readers/svg/document/document.h"
#include "readers/svg/words/offset.h"
#include "readers/svg/words/paints.h"
#include "readers/svg/words/values.h"

/* The properties of texts: fonts, spacing, anchor, direction. All are inherited except `own`. */
/* Which part of a text lies at its position. In a text that runs to the right, the start is on the
 * left. */
typedef enum cs_svg_anchor {
  CS_SVG_ANCHOR_START,
  CS_SVG_ANCHOR_MIDDLE,
  CS_SVG_ANCHOR_END
} cs_svg_anchor;

/* The line of a letter that is placed at its y. */
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
  cs_svg_baseline dominant, own; /* own: the value of the element itself, not inherited */
  /* the sum of the baseline-shift of this element and of those around it, in user units */
  double raised;
  bool is_leftward;  /* the direction of texts */
  bool is_preserved; /* all spaces of a text are kept */
} cs_svg_text_style;

/* Reads the properties of texts from `values`, the winning values by name. em: of the element;
 * percentages are shares of its font size. parent_em: the font size of its parent, in user units.
 * *out contains the inherited style. */
void cs_svg_text_style_read(const cs_svg_node *node, const char *const *values,
                            const cs_svg_measure *em, double parent_em, cs_svg_text_style *out);

typedef struct cs_svg_style {
  /* inherited */
  const cs_svg_variable *variables;
  cs_svg_colour colour;
  cs_svg_paint fill, stroke;
  cs_svg_paint context_fill, context_stroke; /* of the `use` or marker that shows the element */
  double fill_opacity, stroke_opacity;       /* 0..1 */
  celspan_rule fill_rule, clip_rule;
  cs_svg_length stroke_width, dash_offset;
  celspan_stroke_cap cap;
  celspan_stroke_join join;
  double miter;
  const char *dashes;          /* stroke-dasharray; NULL: none */
  cs_svg_layer paint_order[3]; /* the lowest first */
  double font_size;            /* user units */
  cs_svg_text_style text;
  bool is_visible;
  bool filters_codes;          /* filters mix the codes of colours, not light */
  cs_svg_reference markers[3]; /* start, mid, end */
  /* of the element alone */
  bool is_displayed;
  double opacity;
  cs_svg_reference clip_path, mask;
  const char *filter;     /* a list of filters; NULL: none */
  const char *clip_shape; /* clip-path, if it is a shape; NULL: it is a reference, or none */
  bool has_clip_path, has_mask;
  celspan_blend blend;
  bool isolates;                           /* blend modes inside do not act on its background */
  bool keeps_width;                        /* transforms do not change the width of the stroke */
  bool shows_overflow;                     /* for svg, symbol and marker elements */
  bool uses_alpha;                         /* a mask uses alpha instead of luminance */
  cs_svg_colour light_colour;              /* the light colour of filters */
  cs_svg_colour stop_colour, flood_colour; /* with stop-opacity or flood-opacity applied */
  /* Functions, and the properties that are applied after them; NULL: none. */
  const char *transform, *translate, *rotate, *scale;
  const char *transform_origin; /* NULL: none */
  bool is_about_box;            /* transforms take shares and origin from the element's own box */
  cs_svg_offset offset;         /* applied after the functions, and before the properties */
  const celspan_matrix *motion; /* applied after all of them; NULL: none */
} cs_svg_style;

cs_svg_style cs_svg_style_initial(void);

/* The style of a node, given the style of its parent. tests: how many tests of selectors are left;
 * counted down. Errors: LIMIT if none are left; INPUT for an unfit number. */
CELSPAN_CHECKED celspan_status cs_svg_style_resolve(celspan_context *context,
                                                    cs_svg_document *document,
                                                    const cs_svg_node *node,
                                                    const cs_svg_style *parent, uint64_t *tests,
                                                    cs_svg_style *out);
