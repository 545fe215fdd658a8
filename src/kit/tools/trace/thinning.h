/* Regions thinned to lines of single pixels.
 *
 *      . # # # # # .         . . . . . . .       each colour by itself, from all sides at once, as
 *      . # # # # # .   -->   . . # # # . .       long as it hangs together and has its ends
 *      . # # # # # .         . . . . . . .
 *
 * Zhang and Suen, "A fast parallel algorithm for thinning digital patterns", 1984. In addition, a
 * pixel stays if, when its turn comes, it connects other pixels that are left. So nothing vanishes.
 *
 * INVARIANT: a pixel that is left can not be taken away without taking a line apart or shortening
 * it.
 */
#pragma once

#include "inside/context.h"
#include "tools/trace/labels.h"

/* A plane of pixels with a rim of one pixel, like labels: 1 + label, 0: not drawn. */
typedef struct cs_thin {
  int32_t width, height;
  size_t stride;
  CS_ARRAY(unsigned char, plane);
  /* thirds of a pixel to the nearest pixel that is not drawn, before thinning */
  CS_ARRAY(uint16_t, depths);
} cs_thin;

/* The neighbours of a pixel, clockwise from the one above, as offsets into the plane. */
void cs_thin_offsets(const cs_thin *thin, ptrdiff_t offsets[8]);

/* ground: the label that is not drawn; pixels without a label are not drawn, either. Errors:
 * NO_MEMORY. After a failure nothing must be finished. */
CELSPAN_CHECKED celspan_status cs_thin_make(celspan_context *context, const cs_material *material,
                                            unsigned char ground, cs_thin *out);
/* Removes pixels at the right angles of lines: the two neighbours of such a pixel touch at a
 * corner, so the line stays connected. places: the pixels that are examined. */
void cs_thin_tidy(cs_thin *thin, const uint32_t *places, size_t count);
void cs_thin_finish(cs_thin *thin, celspan_context *context);

/* The graph of thinned lines: branches of pixels from end or fork to end or fork, or around.
 *
 *      o                     o: ends     f: forks, with three neighbours or more
 *       \      .--o         a branch that ends within the width of the line that it leaves is
 *        .--f--.             a spur of thinning, and goes
 *           |
 *           o
 *
 * INVARIANT: every pixel of a thinned line is in one branch, except forks, at which several
 * branches end.
 */

typedef struct cs_branch {
  size_t first, count; /* places in the plane of thinned lines */
  bool is_closed;
} cs_branch;

typedef struct cs_branches {
  CS_ARRAY(cs_branch, list);
  CS_ARRAY(uint32_t, places);
  size_t count, place_count;
} cs_branches;

/* Errors: NO_MEMORY. *out must be finished also after an error. */
CELSPAN_CHECKED celspan_status cs_branches_find(celspan_context *context, cs_thin *thin,
                                                cs_branches *out);
void cs_branches_finish(cs_branches *branches, celspan_context *context);
