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
#pragma once

#include "model/stroke/curve.h"

/* Building the line of a stroke: pieces with their radii.
 *
 *   points, widths --> spline --\
 *   path data      --> subpaths ---> raw line --> pieces with a length --> parts (parts.h)
 *   a primitive    --> outline  --/
 */

/* A line as it was given. If `widths` has pieces, they belong to the pieces of the line: their x is
 * the width. */
typedef struct cs_stroke_raw {
  cs_outline line, widths;
  cs_outline_closed closed; /* contours */
  double width;             /* the width of a line without widths */
} cs_stroke_raw;

/* Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. cs_stroke_raw_finish frees it, also after an error. */
CELSPAN_CHECKED celspan_status cs_stroke_raw_init(celspan_context *context, cs_stroke_raw *raw,
                                                  const celspan_stroke_desc *desc,
                                                  const cs_outline *outline,
                                                  const cs_outline_closed *closed);
void cs_stroke_raw_finish(cs_stroke_raw *raw, cs_memory *memory);

/* Appends a piece to the stroke's line, which continues where the line ends; is_first: the piece
 * begins a contour. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_append(celspan_context *context, cs_stroke *stroke,
                                                const cs_curve *curve, bool is_first);
/* Appends a contour of the raw line, without pieces that are points. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_stroke_append_contour(celspan_context *context, cs_stroke *stroke,
                                                        const cs_stroke_raw *raw, size_t contour);

/* Sets the parts. closed: contours of the line. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_divide(celspan_context *context, cs_stroke *stroke,
                                                const celspan_stroke_desc *desc,
                                                const cs_outline_closed *closed);
/* Makes the line again from the stroke's parts, with tapered radii. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_taper(celspan_context *context, cs_stroke *stroke,
                                               const celspan_stroke_desc *desc);
