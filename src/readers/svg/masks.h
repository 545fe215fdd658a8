/* Flat masks: those whose shapes have one colour each and hide one another entirely, or do not
 * overlap. What lies under such a mask is cut into pieces with a share each.
 */
#pragma once

#include "readers/svg/art.h"
#include "readers/svg/reading.h"

/* The mask of an element at `place`. *out: NULL when the reference leads to no mask, or to one that
 * is not flat, which is noted. */
CELSPAN_CHECKED celspan_status cs_svg_mask_make(cs_svg_reading *reading, celspan_svg *art,
                                                const cs_svg_node *node, const cs_svg_place *place,
                                                cs_svg_mask **out);
