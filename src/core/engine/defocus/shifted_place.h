/* Which pixels of a shifted cel are shown on a frame, and which ones are read for them.
 *
 *      .-- - - - - - --.
 *      :  what is read :      read: as far as the shift may lead from what is shown, where the
 *      :   +---------------+  art is; by: of what displaces, the pixels that are shown
 *      :   |     shown :   |
 *      '-- | - - - - --'   | <-- frame
 *          +---------------+
 *
 * Nothing here depends on crops, except where the layer is visible.
 */
#pragma once

#include "engine/defocus/own_grid.h"

/* A rectangle of whole pixels; empty where an end is not beyond its start. */
typedef struct cs_shifted_part {
  int32_t first[2], end[2];
} cs_shifted_part;

typedef struct cs_shifted_place {
  cs_shifted_part shown, read, by;
  cs_shifted map; /* to be finished by cs_shifted_init */
} cs_shifted_place;

static inline bool cs_shifted_part_has_pixels(const cs_shifted_part *part) {
  return part->first[0] < part->end[0] && part->first[1] < part->end[1];
}

/* *is_seen: false where nothing can be seen. visible: where the layer is present. Errors:
 * NO_MEMORY; LIMIT where far too much would be read. */
CELSPAN_CHECKED celspan_status cs_shifted_place_find(celspan_context *context,
                                                     const cs_defocus_cel *place, bool *is_seen,
                                                     cs_boundary_frame *visible,
                                                     cs_shifted_place *out);
