/* The property `filter` as written: a list of functions of CSS and of references to filters.
 *
 *     "blur(2px) url(#f) sepia(50%)" --> one call after the other
 *
 * Source: Filter Effects Module Level 1, 5 and 6.1.
 */
#pragma once

#include "readers/svg/words/colours.h"
#include "readers/svg/words/values.h"

typedef enum cs_svg_filter_kind {
  CS_SVG_FILTER_BLUR,
  CS_SVG_FILTER_BRIGHTNESS,
  CS_SVG_FILTER_CONTRAST,
  CS_SVG_FILTER_SHADOW,
  CS_SVG_FILTER_GRAYSCALE,
  CS_SVG_FILTER_HUE,
  CS_SVG_FILTER_INVERT,
  CS_SVG_FILTER_OPACITY,
  CS_SVG_FILTER_SATURATE,
  CS_SVG_FILTER_SEPIA,
  CS_SVG_FILTER_REFERENCE
} cs_svg_filter_kind;

typedef struct cs_svg_filter_call {
  cs_svg_filter_kind kind;
  cs_svg_reference reference; /* REFERENCE */
  double amount;              /* the amount of colours: 0 or more, or degrees */
  cs_svg_length lengths[3];   /* BLUR: the first; SHADOW: along x, along y, the deviation */
  bool is_bare;               /* a length other than 0 was written without a unit */
  bool has_colour;            /* SHADOW; false: the colour of the property `color` */
  cs_svg_colour colour;
} cs_svg_filter_call;

/* The name of a function. */
const char *cs_svg_filter_name(cs_svg_filter_kind kind);
/* Reads the call at the beginning of *text and moves *text to the next call; false: there is no
 * call. */
bool cs_svg_take_filter(const char **text, cs_svg_filter_call *out);
/* Whether the whole value is a list of calls. is_style: lengths need units, which are optional in
 * attributes. */
bool cs_svg_is_filter_list(const char *text, bool is_style);
