/* A straight piece of an edge between two heights.
 *
 *     (xa, ya) *
 *               \
 *                * (xb, yb)
 */
#pragma once

#include <stdint.h>

typedef struct cs_segment {
  double xa, ya, xb, yb; /* pixels, from (xa, ya) down to (xb, yb) */
  uint32_t chain;        /* that it is a part of, plus 1; 0: of none */
} cs_segment;
