/* The store of bands of soft layers: one in a context, shared by its threads and its frames, within
 * a budget. What a band holds is a function of its key, so neither budget nor threads show; a
 * defocused cel that did not change from one frame to the next finds its bands made.
 *
 * Invariants: a band is made by one thread while others wait for it; one that is held is never
 * dropped; the bands that nobody holds go first used, first dropped.
 */
#ifndef CS_FILTER_SOFT_BANDS_H
#define CS_FILTER_SOFT_BANDS_H

#include "base/hash.h"
#include "compose/soft.h"

typedef struct cs_band_key {
  cs_hash layer;
  int32_t number;
} cs_band_key;

/* Fills an empty band, whole or in part: the store frees it. */
typedef celspan_status (*cs_band_maker)(const void *layer, celspan_context *context, int32_t number,
                                        cs_soft_band *band);

typedef struct cs_band_counts { /* since the context was made; now */
  uint64_t made, found;
  size_t bytes;
} cs_band_counts;

/* Makes the store where there is none yet. Any thread. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_soft_bands_ready(celspan_context *context);
/* Errors: NO_MEMORY and those of `make`. */
CELSPAN_CHECKED celspan_status cs_soft_bands_acquire(celspan_context *context,
                                                     const cs_band_key *key, cs_band_maker make,
                                                     const void *layer, cs_soft_band **out);
void cs_soft_bands_release(celspan_context *context, cs_soft_band *band);
cs_band_counts cs_soft_bands_count(celspan_context *context);

#endif
