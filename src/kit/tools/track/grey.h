/* Grey pictures at halved sizes, for following what moves in them.
 *
 *   level 0   +---+---+---+---+    pixel i is centred at x = i; all places here are of that kind
 *             | 0 | 1 | 2 | 3 |
 *             +---+---+---+---+
 *   level 1   |   0   |   1   |    its pixel i lies over pixels 2 i and 2 i + 1: x' = (x - 0.5) / 2
 *             +-------+-------+
 *
 * A level is the one before it, smoothed by the binomial weights 1 3 3 1 in both directions.
 */
#pragma once

#include "inside/context.h"

enum { CS_GREY_LEVELS = 6 };

typedef struct cs_grey {
  int32_t width, height;
  float *values; /* rows from top to bottom, `width` each */
} cs_grey;

typedef struct cs_grey_levels {
  cs_memory *memory;
  int32_t count; /* the count of levels */
  cs_grey levels[CS_GREY_LEVELS];
} cs_grey_levels;

/* values: width x height, copied. count: the wanted number of levels; there are fewer if one would
 * be narrower than 16 pixels. out: new, for cs_grey_levels_finish. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_grey_levels_make(celspan_context *context, const float *values,
                                                   int32_t width, int32_t height, int32_t count,
                                                   cs_grey_levels *out);
void cs_grey_levels_finish(cs_grey_levels *levels); /* also if it is all zero */

/* Converts a place on level 0 to a level, and in the other direction. */
static inline double cs_grey_down(double at, int32_t level) {
  double scale = 1.0 / (double)(1 << level);
  return (at + 0.5) * scale - 0.5;
}
static inline double cs_grey_up(double at, int32_t level) {
  double scale = (double)(1 << level);
  return (at + 0.5) * scale - 0.5;
}

/* Where in a region a picture can be held on to: pixels around which its slopes go in two
 * directions (Shi and Tomasi 1994).
 *
 *     flat          edge          corner
 *    . . . .       . . # #       . . . .      The smaller eigenvalue of the sum of slope times
 *    . . . .       . . # #       . . # #      slope over a square is large at corners alone.
 *    . . . .       . . # #       . . # #
 */

enum { CS_FEATURES_MOST = 240 };

/* Pixels [x0, x1) x [y0, y1), of which only those count where mask (one byte for each pixel of the
 * picture) is not 0. mask NULL: all. */
typedef struct cs_features_region {
  int32_t x0, y0, x1, y1;
  const uint8_t *mask;
} cs_features_region;

/* Finds the strongest corners, spread over the region. out: room for CS_FEATURES_MOST. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_features_find(celspan_context *context, const cs_grey *grey,
                                                const cs_features_region *region,
                                                celspan_point *out, size_t *count);
