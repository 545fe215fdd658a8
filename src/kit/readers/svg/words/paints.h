/* The paint of a fill or a stroke, as written: a colour, currentColor, none, or a reference with
 * one of these as its fallback. */
#pragma once

#include "readers/svg/words/colours.h"
#include "readers/svg/words/values.h"

typedef enum cs_svg_paint_kind {
  CS_SVG_PAINT_NONE,
  CS_SVG_PAINT_COLOUR,
  CS_SVG_PAINT_CURRENT /* the colour of the property `color` */
} cs_svg_paint_kind;

typedef struct cs_svg_paint {
  bool has_server;
  /* if it exists and can be drawn, it is used instead of the other fields */
  cs_svg_reference server;
  bool has_fallback; /* a fallback was written after the reference */
  cs_svg_paint_kind kind;
  cs_svg_colour colour;
  /* the element that the paint was inherited from; NULL: the shape */
  const struct cs_svg_context_box *context;
} cs_svg_paint;

/* The parts with which a shape is painted, one over the other. */
typedef enum cs_svg_layer {
  CS_SVG_LAYER_FILL,
  CS_SVG_LAYER_STROKE,
  CS_SVG_LAYER_MARKERS
} cs_svg_layer;

/* Each function reads the whole value; false: the value is invalid. */
bool cs_svg_parse_paint(const char *text, cs_svg_paint *out);
/* The lowest layer is first: the named layers in that order, then the other layers in their usual
 * order. */
bool cs_svg_parse_order(const char *text, cs_svg_layer out[3]);
