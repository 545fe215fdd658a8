/* Rectangles as objects, and units in which a box has the sides 1 and 1. */
#ifndef CS_SVG_RECTANGLES_H
#define CS_SVG_RECTANGLES_H

#include "svg/reading.h"

/* A rectangle of user units, which `matrix` brings to the drawing's, as an object. */
CELSPAN_CHECKED celspan_status cs_svg_rectangle(cs_svg_reading *reading, const celspan_box *box,
                                                const celspan_matrix *matrix, celspan_object **out);
/* Units that are shares of a box, to user units. */
celspan_matrix cs_svg_box_matrix(const celspan_box *box);

#endif
