/* Where in a region a picture can be held on to: pixels around which its slopes go in two
 * directions (Shi and Tomasi 1994).
 *
 *     flat          edge          corner
 *    . . . .       . . # #       . . . .      The smaller eigenvalue of the sum of slope times
 *    . . . .       . . # #       . . # #      slope over a square is large at corners alone.
 *    . . . .       . . # #       . . # #
 */
#ifndef CS_TRACK_FEATURES_H
#define CS_TRACK_FEATURES_H

#include "track/plane.h"

enum { CS_FEATURES_MOST = 240 };

/* Pixels [x0, x1) x [y0, y1), and of these where mask (one byte a pixel of the picture) is not 0.
 * mask NULL: all. */
typedef struct cs_features_region {
  int32_t x0, y0, x1, y1;
  const uint8_t *mask;
} cs_features_region;

/* The strongest corners, spread over the region, into `out`, which has room for CS_FEATURES_MOST.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_features_find(celspan_context *context, const cs_plane *plane,
                                                const cs_features_region *region,
                                                celspan_point *out, size_t *count);

#endif
