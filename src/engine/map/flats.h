/* The flat boundaries of a map, which its rows do not need: they lie between the ends of borders.
 *
 *            above
 *       A  /  A    \  B        at one height, from left to right: what changes from above to below
 *     ----o---------o-----       begins and ends where borders begin and end. From the first end to
 *       A  \  C  /   B           the second one A becomes C, so a flat boundary lies there.
 *            below
 *
 * Invariant: with them each cell is bounded on all sides: the heights of the lines around it, with
 * their signs, add up to 0 however the map is turned.
 */
#pragma once

#include "engine/map/map.h"

/* Finds the flat boundaries. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_find_flats(celspan_context *context, cs_map *map);
