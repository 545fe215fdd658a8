/* The values of animate, animateTransform and set. */
#pragma once

#include "readers/svg/motion_targets.h"

/* Applies the animation to the value so far, *text; NULL: the value without animations. Errors:
 * NO_MEMORY; as for styles. */
CELSPAN_CHECKED celspan_status cs_svg_animate(cs_svg_reading *reading,
                                              const cs_svg_animation *animation,
                                              const cs_svg_progress *progress, const char **text);
