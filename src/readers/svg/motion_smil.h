/* The animation elements of a document: all of them, at its time. */
#pragma once

#include "readers/svg/motion_times.h"
#include "readers/svg/reading.h"

/* Runs them, and adds them to *extent. Errors: as cs_svg_move. */
CELSPAN_CHECKED celspan_status cs_svg_smil_run(cs_svg_reading *reading, cs_svg_extent *extent);
