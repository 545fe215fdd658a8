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

/* x at a height between its ends. */
static inline double cs_segment_x(const cs_segment *line, double y) {
  double height = line->yb - line->ya;
  return line->xa + (line->xb - line->xa) * ((y - line->ya) / height);
}
