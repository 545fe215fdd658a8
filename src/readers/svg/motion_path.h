/* animateMotion: places on a line, or between points. */
#pragma once

#include "readers/svg/motion_targets.h"

/* Adds an animateMotion to the motion of its target. Errors: NO_MEMORY, LIMIT; INPUT for unfit
 * numbers. */
CELSPAN_CHECKED celspan_status cs_svg_motion_path(cs_svg_reading *reading,
                                                  const cs_svg_animation *animation,
                                                  const cs_svg_progress *progress,
                                                  const celspan_matrix **motion);
