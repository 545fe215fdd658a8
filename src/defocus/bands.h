/* The store of bands of soft layers: one in a context, shared by its threads and its frames, within
 * a budget. What a band holds is a function of its key, so neither budget nor threads show; a
 * defocused cel that did not change from one frame to the next finds its bands made.
 *
 * Invariants: a band is made by one thread while others wait for it; one that is held is never
 * dropped; the bands that nobody holds go first used, first dropped.
 */
#ifndef CS_DEFOCUS_BANDS_H
#define CS_DEFOCUS_BANDS_H

#include "base/hash.h"
#include "sample/defocused.h"

typedef struct cs_defocus_bands_key {
  cs_hash layer;
  int32_t number;
} cs_defocus_bands_key;

/* Fills an empty band, whole or in part: the store frees it. */
typedef celspan_status (*cs_defocus_bands_maker)(const void *layer, celspan_context *context,
                                                 int32_t number, cs_defocus_band *band);

typedef struct cs_defocus_bands_counts { /* since the context was made; now */
  uint64_t made, found;
  size_t bytes;
} cs_defocus_bands_counts;

/* Makes the store where there is none yet. Any thread. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_ready(celspan_context *context);
/* Errors: NO_MEMORY and those of `make`. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_acquire(celspan_context *context,
                                                        const cs_defocus_bands_key *key,
                                                        cs_defocus_bands_maker make,
                                                        const void *layer, cs_defocus_band **out);
void cs_defocus_bands_release(celspan_context *context, cs_defocus_band *band);
cs_defocus_bands_counts cs_defocus_bands_count(celspan_context *context);

#endif
