/* Texts: from an element to an item with the outlines of its letters.
 *
 *   element --written.c--> characters --letters.c--> letters --paint.c--> objects
 *
 * An element inside of a text becomes an item inside of the text's item, and so may be a part. */
#pragma once

#include "celspan/svg.h"
#include "inside/geometry.h"
#include "readers/svg/document/art.h"
#include "readers/svg/document/reading.h"

/* Adds the drawing of a text element to `item`; *place has its style. Errors: NO_MEMORY, LIMIT;
 * INPUT for unfit numbers and for fonts that cannot be read. */
CELSPAN_CHECKED celspan_status cs_svg_text_add(cs_svg_reading *reading, celspan_svg *art,
                                               const cs_svg_node *node, const cs_svg_place *place,
                                               cs_svg_item *item);
/* Appends the outlines of all letters of a text, in its user units. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_text_outline(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_place *place, cs_outline *outline);
/* The box around a text, in its user units: see cs_svg_letters_box. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_text_box(cs_svg_reading *reading, const cs_svg_node *node,
                                               const cs_svg_place *place, celspan_box *out,
                                               bool *is_there);
