/* A straight piece of a boundary between two heights, in pixels.
 *
 *     (xa, ya) *
 *               \
 *                * (xb, yb)
 */
#pragma once

typedef struct cs_segment {
  double xa, ya, xb, yb; /* from (xa, ya) down to (xb, yb) */
} cs_segment;
