/* The animations of styles: @keyframes, and the properties that begin with `animation`.
 *
 * Sources: CSS Animations Level 1, Web Animations Level 1.
 */
#pragma once

#include "readers/svg/motion_times.h"
#include "readers/svg/reading.h"

/* Runs them, and adds them to *extent. Errors: as cs_svg_move. */
CELSPAN_CHECKED celspan_status cs_svg_keyframes_run(cs_svg_reading *reading, cs_svg_extent *extent);
