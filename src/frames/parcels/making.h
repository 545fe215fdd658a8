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

/* Appends the arc of a border. Errors: NO_MEMORY; LIMIT. */
CELSPAN_CHECKED celspan_status cs_arc_put(celspan_context *context, const planefile_band *band,
                                          const planefile_border *border, uint32_t left,
                                          uint32_t right, cs_parcels *parcels);
/* Appends one of the frame's sides. */
CELSPAN_CHECKED celspan_status cs_arc_put_side(celspan_context *context, double x, uint32_t left,
                                               uint32_t right, cs_parcels *parcels);

/* BAD_ARGUMENT if places of the plane have several fills, because it is a sum. */
CELSPAN_CHECKED celspan_status cs_parcels_refuse_sums(celspan_context *context,
                                                      const cs_parcels *parcels);
