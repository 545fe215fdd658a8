/* The animation elements of a document, and the properties and attributes of their targets. */
#pragma once

#include "readers/svg/document/reading.h"

/* An animation element. */
typedef struct cs_svg_animation {
  const cs_svg_node *node;
  cs_svg_node *target; /* NULL: none */
  cs_svg_name name;    /* CS_SVG_NAME_COUNT: of animateMotion, or unknown */
} cs_svg_animation;

/* The place where values of this element are made. */
cs_css_place cs_svg_motion_place(const cs_svg_reading *reading, const cs_svg_node *node);
/* Counts `count` bytes or frames that an animation reads against the limit of tests of selectors.
 * Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_motion_count(cs_svg_reading *reading, const cs_svg_node *node,
                                                   size_t count);
/* The value of a property or an attribute, with the animations applied so far; an inherited or
 * initial one if none is given. Errors: as for styles. */
CELSPAN_CHECKED celspan_status cs_svg_motion_base(cs_svg_reading *reading, const cs_svg_node *node,
                                                  cs_svg_name name, const char **out);
/* Gives the element a value, of a property or of an attribute; one that a document may not have is
 * ignored. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_motion_give(cs_svg_reading *reading, cs_svg_node *node,
                                                  cs_svg_name name, const char *value);
CELSPAN_CHECKED celspan_status cs_svg_motion_set(cs_svg_reading *reading, cs_svg_node *node,
                                                 cs_svg_name name, const char *value);
