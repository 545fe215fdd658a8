/* The parts of making parcels: fills.c, arcs.c. */
#pragma once

#include "base/hash_table.h"
#include "frames/parcels/parcels.h"
#include "frames/plane/plane_data.h"

/* Fills by what they are, so that each is there once. */
typedef struct cs_fill_table {
  cs_hash_table known;
  uint32_t picture; /* the number of the fill of pictures; 0: none yet */
} cs_fill_table;

/* The fill of a cell, a new one if need be. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_fill_find(celspan_context *context, const celspan_plane *plane,
                                            const planefile_band *band, uint32_t cell,
                                            cs_fill_table *table, cs_parcels *parcels,
                                            uint32_t *out);

/* Borders beyond the sides of the frame, 0 on the left and 1 on the right: at a height, by how much
 * the sum of their fills changes. */
typedef struct cs_side_change {
  int side;
  int32_t height;
  int64_t by;
} cs_side_change;

typedef struct cs_frame_sides {
  cs_side_change *changes;
  size_t count, capacity;
} cs_frame_sides;

/* Adds a part of a border. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sides_add(celspan_context *context, cs_frame_sides *sides,
                                            int side, int32_t top, int32_t foot, uint32_t left,
                                            uint32_t right);
/* Appends the arcs along the sides. Errors: those of cs_arc_put. */
CELSPAN_CHECKED celspan_status cs_sides_put(celspan_context *context, cs_frame_sides *sides,
                                            cs_parcels *parcels);
void cs_sides_finish(cs_frame_sides *sides, cs_memory *memory);

/* Appends the arcs of a border, and adds the parts beyond the frame. Errors: NO_MEMORY; LIMIT. */
CELSPAN_CHECKED celspan_status cs_arc_put(celspan_context *context, const planefile_band *band,
                                          const planefile_border *border, uint32_t left,
                                          uint32_t right, cs_frame_sides *sides,
                                          cs_parcels *parcels);
/* Appends a part of one of the frame's sides, inside of which there is a fill. */
CELSPAN_CHECKED celspan_status cs_arc_put_side(celspan_context *context, int side, int32_t top,
                                               int32_t foot, uint32_t fill, cs_parcels *parcels);

/* An arc at a height, and where. */
typedef struct cs_passing {
  double x;
  uint32_t arc;
} cs_passing;
/* The arcs at a height, from left to right. share: of the frame's height. out: room for all arcs.
 * Returns how many there are. */
size_t cs_passing_list(const cs_parcels *parcels, double share, cs_passing *out);

/* BAD_ARGUMENT if places of the plane have several fills, because it is a sum. */
CELSPAN_CHECKED celspan_status cs_parcels_refuse_sums(celspan_context *context,
                                                      const cs_parcels *parcels);
