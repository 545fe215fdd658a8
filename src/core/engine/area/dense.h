/* Dense intervals: very many boundaries share few pixels, so that following every intersection
 * would cost the square of their number, and show nothing.
 *
 *   y0  +--------+--------+        The interval is cut into sub-rows by height. In each of them its
 *       |.\..|./.|.|..\./.| sub-   boundaries are put in order at its middle, and the row
 *       |..\.|/..|..|../..| row    of cells between them is added to the pixels: exact along x
 *       |...\|..|...|./.\.|        within 1/256 pixel, a mean of many sub-rows along y.
 *       |../.|.|.....\|...|
 *   y1  +--------+--------+        Each pixel becomes one flat cell, so later steps do not
 *    left   flat    flat    right  grow with the number of boundaries.
 *
 * The cost is sorting: a boundary costs one sort per sub-row, a pixel at most 256 cells in
 * each. The mean over the sub-rows of a pixel is within 1/255 (root of the mean square, of the
 * brightest light) of the exact one; that of an interval which is not dense stays exact.
 *
 * Invariant: as for local sweeps (local_sweep.h): nothing changes left and right of the interval.
 */
#pragma once

#include "engine/area/local_sweep.h"

/* an interval with this many boundaries for each pixel, on the average, or more, is dense */
#define CS_DENSE_A_PIXEL 16

/* Where a boundary lies in a sub-row. */
typedef struct cs_dense_place {
  uint32_t x; /* the position in parts of a pixel, from the left of the interval */
  uint32_t member;
} cs_dense_place;

typedef struct cs_dense {
  CS_ARRAY(cs_dense_place, places); /* of several sub-rows, room for all members each */
  CS_ARRAY(cs_dense_place, spare);  /* room for all members */
  CS_ARRAY(cs_sum4, sums);          /* one for each pixel of the interval */
} cs_dense;

void cs_dense_finish(cs_dense *dense, cs_memory *memory);
/* Whether members at the top of a row that lie within an extent, in pixels, are dense. Members that
 * begin in the row are not counted: they are replayed exactly, even if they are small and
 * regular. */
bool cs_dense_suits(size_t members, double extent);
/* Draws the members of a sweep, and those that begin, from sweep->y0 to sweep->y1. The composer is
 * left of all members, before and after the call. extent: the columns of the members; right: the
 * cell right of the members. Errors: NO_MEMORY, and the errors of painting. */
CELSPAN_CHECKED celspan_status cs_dense_draw(cs_dense *dense, cs_local_sweep *sweep,
                                             cs_extent extent, const cs_cell *right);
