/* Lists of transforms that do not have the same functions, mixed. */
#pragma once

#include "readers/svg/motion_values.h"

/* a + (b - a) share: if one of the lists continues the other, with functions that do nothing at the
 * end of the shorter one; otherwise as matrices. Lists that have no matrices change in the middle.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_matrices_mix(const cs_css_place *place, const cs_svg_mixed *a,
                                                   const cs_svg_mixed *b, double share,
                                                   cs_svg_mixed *out);
