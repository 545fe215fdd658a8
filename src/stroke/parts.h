/* The parts of a line that are drawn.
 *
 *    line      |--------------------------------------------|
 *    from, to        |-------------------------------|           shares of the whole length
 *    dashes    |------|  |------|  |------|  |------|  |----     from every contour's beginning
 *    parts           ==  ========  ========  =======
 *
 * Without dashes, taper scales the radius by the way from the ends of a part: what is not drawn is
 * then cut off the line.
 */
#ifndef CS_STROKE_PARTS_H
#define CS_STROKE_PARTS_H

#include "stroke/line.h"

/* Sets the parts. closed: contours of the line. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_divide(celspan_context *context, cs_stroke *stroke,
                                                const celspan_stroke_desc *desc,
                                                const cs_outline_closed *closed);
/* Makes the line anew of the stroke's parts, with tapered radii. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_taper(celspan_context *context, cs_stroke *stroke,
                                               const double taper[2]);

#endif
