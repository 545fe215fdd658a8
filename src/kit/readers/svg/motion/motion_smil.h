/* What the animation elements of a document are made of: the attributes of time (dur, begin, end,
 * repeatCount, ...), the values of animate, animateTransform and set, and the places of
 * animateMotion on a line or between points. */
#pragma once

#include "readers/svg/motion/motion_targets.h"
#include "readers/svg/motion/motion_times.h"

/* The animations of a document, in its order. */
typedef struct cs_svg_animations {
  cs_svg_reading *reading;
  cs_svg_animation *items;
  size_t count;
} cs_svg_animations;

/* Notes moments that only an event or a script gives. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_timing_read(const cs_svg_animations *all,
                                                  const cs_svg_node *node, cs_svg_timing *out);

/* Applies the animation to the value so far, *text; NULL: the value without animations. Errors:
 * NO_MEMORY; as for styles. */
CELSPAN_CHECKED celspan_status cs_svg_animate(cs_svg_reading *reading,
                                              const cs_svg_animation *animation,
                                              const cs_svg_progress *progress, const char **text);

/* Adds an animateMotion to the motion of its target. Errors: NO_MEMORY, LIMIT; INPUT for unfit
 * numbers. */
CELSPAN_CHECKED celspan_status cs_svg_motion_path(cs_svg_reading *reading,
                                                  const cs_svg_animation *animation,
                                                  const cs_svg_progress *progress,
                                                  const celspan_matrix **motion);
