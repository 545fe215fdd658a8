/* Lines that texts run along: textPath.
 *
 *          ,-B-.         x of a letter is counted along the line, y across it; the middle of the
 *        A       C       letter lies on the line, and the letter is turned as the line goes there.
 *       /         \      Letters whose middle is beyond an end are not drawn.
 *
 * Source: SVG 2, 11.8.3.
 */
#pragma once

#include "model/geometry/outline.h"
#include "readers/svg/reading.h"

typedef struct cs_svg_text_path {
  size_t begin, end;  /* characters of the text */
  cs_outline outline; /* in the text's user units */
  double *lengths;    /* by piece: of all pieces before it */
  double length;      /* of all */
  double start;       /* where the first letter begins */
} cs_svg_text_path;

/* The line that a textPath element at `place` names. *is_there: false where there is no line, or
 * one without a length. *out must be finished even after a failure. Errors: NO_MEMORY, LIMIT; INPUT
 * for numbers that are unfit. */
CELSPAN_CHECKED celspan_status cs_svg_text_path_make(cs_svg_reading *reading,
                                                     const cs_svg_node *node,
                                                     const cs_svg_place *place,
                                                     cs_svg_text_path *out, bool *is_there);
void cs_svg_text_path_finish(cs_svg_text_path *path, cs_memory *memory);

/* The point at a distance from the line's begin, 0 .. length, and the direction there in degrees.
 */
celspan_point cs_svg_text_path_at(const cs_svg_text_path *path, double distance, double *degrees);
