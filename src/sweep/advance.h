/* What every row does to every boundary, in vector code: x at the next height, which segments end
 * on the way, and whether the order still holds. */
#ifndef CS_SWEEP_ADVANCE_H
#define CS_SWEEP_ADVANCE_H

#include "base/wide.h"
#include <stdbool.h>
#include <stddef.h>

/* Boundaries are taken so many at a time, at most, and some beyond the last with them: all arrays
 * have room for CS_ADVANCE_BATCH more than the count. What is there does not matter. */
#define CS_ADVANCE_BATCH 16

/* The numbers [0, n) in whole batches. */
static inline size_t cs_advance_whole(size_t n) {
  return (n + CS_ADVANCE_BATCH - 1) / CS_ADVANCE_BATCH * CS_ADVANCE_BATCH;
}

/* Segments: their tops, how x goes on from there, their feet; arrays of `count`. */
typedef struct cs_segments {
  const double *x0, *y0, *slope, *curve, *y1;
} cs_segments;

/* How many segments end at or above the height reached, and how many boundaries do not lie right of
 * the one before them there. */
typedef struct cs_advanced {
  size_t ended, falls;
} cs_advanced;

/* Fills x_next with x at height y, and `ended` with the numbers of those that end. */
CS_WIDE_DECLARE(cs_advanced, cs_advance_to,
                (const cs_segments *segments, size_t count, double y, double *x_next,
                 uint32_t *ended));
/* Whether each of x is less than the one after it. */
CS_WIDE_DECLARE(bool, cs_advance_rises, (const double *x, size_t count));

#endif
