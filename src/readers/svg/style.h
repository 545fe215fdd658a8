/* The style of an element: its properties, computed from the values that win (cascade.h) and
 * from what it inherits.
 */
#pragma once

#include "readers/svg/document.h"
#include "readers/svg/paints.h"
#include "readers/svg/text_style.h"
#include "readers/svg/values.h"

typedef struct cs_svg_style {
  /* inherited */
  const cs_svg_variable *variables;
  cs_svg_colour colour;
  cs_svg_paint fill, stroke;
  cs_svg_paint context_fill, context_stroke; /* of the `use` or marker that shows it */
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
  const char *clip_shape; /* clip-path where it is a shape; NULL: it is a reference, or none */
  bool has_clip_path, has_mask;
  celspan_blend blend;
  bool isolates;                           /* blend modes inside do not see its background */
  bool keeps_width;                        /* the stroke's: transforms do not change it */
  bool shows_overflow;                     /* of svg, symbol and marker elements */
  bool uses_alpha;                         /* of a mask: alpha instead of luminance */
  cs_svg_colour stop_colour, flood_colour; /* stop-opacity, flood-opacity multiplied in */
  /* Functions, and the properties done after them; NULL: none. */
  const char *transform, *translate, *rotate, *scale;
  const char *transform_origin; /* NULL: none */
} cs_svg_style;

cs_svg_style cs_svg_style_initial(void);

/* node's style, given the style of its parent. tests: how often selectors may still be tried,
 * counted down. Errors: LIMIT when that is used up; INPUT for a number that is unfit. */
CELSPAN_CHECKED celspan_status cs_svg_style_resolve(celspan_context *context,
                                                    cs_svg_document *document,
                                                    const cs_svg_node *node,
                                                    const cs_svg_style *parent, uint64_t *tests,
                                                    cs_svg_style *out);
