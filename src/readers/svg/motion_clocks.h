/* The attributes of time of animation elements: dur, begin, end, repeatCount, ... */
#pragma once

#include "readers/svg/motion_targets.h"
#include "readers/svg/motion_times.h"

/* The animations of a document, in its order. */
typedef struct cs_svg_animations {
  cs_svg_reading *reading;
  cs_svg_animation *items;
  size_t count;
} cs_svg_animations;

/* Notes moments that only an event or a script gives. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_timing_read(const cs_svg_animations *all,
                                                  const cs_svg_node *node, cs_svg_timing *out);
