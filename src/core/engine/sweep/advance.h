/* The part of advancing that every row does to every boundary, in vector code: x at the next
 * height, which segments end before it, and whether the order still holds.
 *
 *        (x0, y0)  top of the segment
 *            *
 *             \          with d = y - y0:   x(y) = x0 + d * (slope + d * curve)
 *   ----------- + ------------------------------------------ y
 *                |       curve is 0 on a straight segment and not on an arc
 *                *
 *              y1        y1 <= y: the segment has ended
 */
#pragma once

#include "base/wide.h"
#include <stdbool.h>
#include <stddef.h>

/* The most boundaries that one instruction handles. The last batch may go beyond the count, so all
 * arrays have room for CS_ADVANCE_BATCH more; the values of those elements do not matter. */
#define CS_ADVANCE_BATCH 16

/* n rounded up to whole batches. */
static inline size_t cs_advance_whole(size_t n) {
  return (n + CS_ADVANCE_BATCH - 1) / CS_ADVANCE_BATCH * CS_ADVANCE_BATCH;
}

/* The current segments of the boundaries: five arrays. */
typedef struct cs_segments {
  double *x0, *y0;       /* top */
  double *slope, *curve; /* dx/dy at the top, and half of d2x/dy2 */
  double *y1;            /* foot */
} cs_segments;

/* How many segments end at or above the height, and how many boundaries do not lie to the right of
 * the boundary before them there. */
typedef struct cs_advanced {
  size_t ended, falls;
} cs_advanced;

/* Fills x_next with x at height y, and `ended` with the indices of the segments that end. */
CS_WIDE_DECLARE(cs_advanced, cs_advance_to,
                (const cs_segments *segments, size_t count, double y, double *x_next,
                 uint32_t *ended));
/* Whether each item of x is less than the next one. */
CS_WIDE_DECLARE(bool, cs_advance_rises, (const double *x, size_t count));
