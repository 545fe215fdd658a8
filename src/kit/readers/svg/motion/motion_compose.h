/* Values of animations that are added to the values without them. */
#pragma once

#include "readers/svg/motion/motion_targets.h"
#include "readers/svg/motion/motion_values.h"

typedef enum cs_svg_composition {
  CS_SVG_COMPOSITION_REPLACE,
  CS_SVG_COMPOSITION_ADD,       /* functions come after those of the other list */
  CS_SVG_COMPOSITION_ACCUMULATE /* numbers of the same functions are added */
} cs_svg_composition;

/* Adds *value of the property to the value with the animations applied so far, which is `under`.
 * Values that do not fit replace it. Errors: NO_MEMORY. Source: CSS Values Level 4, 3.2, and CSS
 * Transforms Level 2, 12. */
CELSPAN_CHECKED celspan_status cs_svg_motion_compose(const cs_css_place *place, cs_svg_name name,
                                                     cs_svg_composition how,
                                                     const cs_svg_mixed *under,
                                                     cs_svg_mixed *value);
