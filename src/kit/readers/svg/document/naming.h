/* The names that an element gives to its item; a part can be found by them. */
#pragma once

#include "celspan/svg.h"
#include "readers/svg/document/art.h"
#include "readers/svg/document/reading.h"

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_item_name(cs_svg_reading *reading, celspan_svg *art,
                                                const cs_svg_node *node, const cs_svg_place *place,
                                                cs_svg_item *item);
