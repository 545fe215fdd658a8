/* Lines that texts run along: textPath.
 *
 *          ,-B-.         x of a letter is counted along the line, y across it; the middle of the
 *        A       C       letter lies on the line, and the letter is turned as the line goes there.
 *       /         \      Letters whose middle is beyond an end are not drawn.
 *
 * Source: SVG 2, 11.8.3.
 */
#ifndef CS_SVG_TEXT_PATH_H
#define CS_SVG_TEXT_PATH_H

#include "geometry/outline.h"
#include "svg/reading.h"

typedef struct cs_svg_way {
  size_t begin, end;  /* characters of the text */
  cs_outline outline; /* in the text's user units */
  double *lengths;    /* by piece: of all pieces before it */
  double length;      /* of all */
  double start;       /* where the first letter begins */
} cs_svg_way;

/* The line that a textPath element at `place` names. *is_there: false for none, or for one without a
 * length. *out is to be finished even after a failure. Errors: NO_MEMORY, LIMIT; INPUT for numbers
 * that are unfit. */
CELSPAN_CHECKED celspan_status cs_svg_way_make(cs_svg_reading *reading, const cs_svg_node *node,
                                               const cs_svg_place *place, cs_svg_way *out,
                                               bool *is_there);
void cs_svg_way_finish(cs_svg_way *way, cs_memory *memory);

/* The point at a distance from the line's begin, 0 .. length, and the direction there in degrees. */
celspan_point cs_svg_way_at(const cs_svg_way *way, double distance, double *degrees);

#endif
