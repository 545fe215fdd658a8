/* The box around the visible parts of an element, without lines and clips. Lengths given as shares
 * of a box are shares of this one.
 *
 *   shapes by their outlines, texts by their lines and advances, images by their places, and all
 *   that is in groups and that `use` shows
 *
 * Source: SVG 2, 8.10.
 */
#pragma once

#include "readers/svg/document/reading.h"

/* The box in the units of `place`; *is_there: false, and *out does not change, if there is no box.
 * Parts that cannot be drawn are noted when the element is drawn. Errors: NO_MEMORY, LIMIT; INPUT
 * for numbers that are unfit. */
CELSPAN_CHECKED celspan_status cs_svg_box_of(cs_svg_reading *reading, const cs_svg_node *node,
                                             const cs_svg_place *place, celspan_box *out,
                                             bool *is_there);
