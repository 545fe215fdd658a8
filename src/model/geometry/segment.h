/* A straight piece of an edge between two heights.
 *
 *     (xa, ya) *
 *               \
 *                * (xb, yb)
 */
#pragma once

typedef struct cs_segment {
  double xa, ya, xb, yb; /* pixels, from (xa, ya) down to (xb, yb) */
} cs_segment;
