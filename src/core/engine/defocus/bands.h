/* The cache of bands: node rows of defocused layers, kept from frame to frame.
 *
 *   frame 1, worker 1 --acquire (layer, 0)--> made ----\
 *   frame 1, worker 2 --acquire (layer, 0)--> waits ----+--> one band of the cache
 *   frame 2, worker 1 --acquire (layer, 0)--> found ---/
 *
 * A context has one such cache, which all its threads and frames share. The key of a band contains
 * a hash of everything that its layer depends on, so a defocused cel that does not change from one
 * frame to the next is not blurred again. The invariants of base/cache.h hold.
 */
#pragma once

#include "base/cache.h"
#include "base/hash.h"
#include "engine/sample/defocused.h"

typedef struct cs_defocus_bands_key {
  cs_hash layer;
  int32_t number;
} cs_defocus_bands_key;

/* Fills an empty band. The cache frees the band, even one whose making has failed half-way. */
typedef celspan_status (*cs_defocus_bands_maker)(const void *layer, celspan_context *context,
                                                 int32_t number, cs_defocus_band *band);

/* Makes the cache if it does not exist yet. Any thread. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_ready(celspan_context *context);
/* Finds a band, or makes it by calling make(layer, ...). Errors: NO_MEMORY, and those of `make`. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_acquire(celspan_context *context,
                                                        const cs_defocus_bands_key *key,
                                                        cs_defocus_bands_maker make,
                                                        const void *layer, cs_defocus_band **out);
void cs_defocus_bands_release(celspan_context *context, cs_defocus_band *band);
cs_cache_counts cs_defocus_bands_count(celspan_context *context);
