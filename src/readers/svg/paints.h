/* The paint of a fill or a stroke, as written: a colour, currentColor, none, or a reference with
 * one of them in case that it leads nowhere.
 */
#pragma once

#include "readers/svg/colours.h"
#include "readers/svg/values.h"

typedef enum cs_svg_paint_kind {
  CS_SVG_PAINT_NONE,
  CS_SVG_PAINT_COLOUR,
  CS_SVG_PAINT_CURRENT /* the colour of the property `color` */
} cs_svg_paint_kind;

typedef struct cs_svg_paint {
  bool has_server;
  cs_svg_reference server; /* wins over the rest where it is found and can be drawn */
  bool has_fallback;       /* the rest was written after a server */
  cs_svg_paint_kind kind;
  cs_svg_colour colour;
  const struct cs_svg_context_box *context; /* the element whose paint it is; NULL: the shape */
} cs_svg_paint;

/* The things that a shape is painted with, one over the other. */
typedef enum cs_svg_layer {
  CS_SVG_LAYER_FILL,
  CS_SVG_LAYER_STROKE,
  CS_SVG_LAYER_MARKERS
} cs_svg_layer;

/* Each takes the whole value; false: it is invalid. */
bool cs_svg_parse_paint(const char *text, cs_svg_paint *out);
/* The lowest layer is first: the named layers in that order, then the other layers in their usual
 * order. */
bool cs_svg_parse_order(const char *text, cs_svg_layer out[3]);
