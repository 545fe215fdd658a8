/* Outlines under a map: each piece is followed by cubics, which are divided until they are right.
 *
 *      p0         p3               q1         a cubic goes through the images of the parameters
 *       *--+---+--*        ->    .*--+-.      0, 1/3, 2/3 and 1. It is compared with the map
 *          1/3 2/3           p0 *   q2  * p3  between these, near where it is furthest from it.
 *
 * Its error falls with the fourth power of its length, so that few are needed. A kink of the map is
 * closed in on from both sides.
 */
#pragma once

#include "model/geometry/outline.h"
#include "model/warp/map.h"

#define CS_WARP_CUBICS 200000 /* the most cubics that one outline may become */

/* Appends the outline, placed by a matrix and then bent. It differs from the true image by at most
 * map->within. Errors: NO_MEMORY; BAD_ARGUMENT if the map jumps or the outline reaches a horizon;
 * LIMIT for a map that is too rough; those of the map. */
CELSPAN_CHECKED celspan_status cs_warp_bend(const cs_warp_map *map, const cs_outline *outline,
                                            const celspan_matrix *matrix, cs_outline *out);
