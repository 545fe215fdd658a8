/* The lines of a map as they lie in a frame that shows it turned, sheared or in perspective.
 *
 *       map                frame
 *         |                   /\         a border that goes up somewhere is divided where it turns
 *    left | right            /  \        back, and each part goes down from its upper end: what is
 *         |             one  |   \       left of it in the map may be right of it in the frame
 *
 * Invariant: a point of the map has one place, so lines that meet in the map meet in the frame.
 */
#pragma once

#include "engine/map/map.h"

/* How far from the frame's corner a drawing may extend, in pixels: points are 32-bit numbers. */
#define CS_MAP_FARTHEST 32000

/* The lines of a map that has its flat boundaries, in units of 2^-16 pixels, without those beyond a
 * frame of these sizes. matrix: from pixels of the raster to pixels of the frame. *fits: false
 * where something of it would be too far away or behind the camera, and there are no lines then.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_turn(celspan_context *context, const cs_map *map,
                                           const celspan_matrix *matrix, const int32_t size[2],
                                           bool *fits, cs_map_lines *out);

/* ---- flats.c */

/* Finds the flat boundaries. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_find_flats(celspan_context *context, cs_map *map);
