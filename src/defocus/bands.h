/* Bands of defocused layers: kept in one cache of the context, shared by its threads and its
 * frames, so that a defocused cel that did not change from one frame to the next finds its bands
 * made. The invariants are those of base/cache.h; a band is made by one thread while others wait
 * for it.
 */
#ifndef CS_DEFOCUS_BANDS_H
#define CS_DEFOCUS_BANDS_H

#include "base/cache.h"
#include "base/hash.h"
#include "sample/defocused.h"

typedef struct cs_defocus_bands_key {
  cs_hash layer;
  int32_t number;
} cs_defocus_bands_key;

/* Fills an empty band, whole or in part: the cache frees it. */
typedef celspan_status (*cs_defocus_bands_maker)(const void *layer, celspan_context *context,
                                                 int32_t number, cs_defocus_band *band);

/* Makes the cache where there is none yet. Any thread. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_ready(celspan_context *context);
/* Errors: NO_MEMORY and those of `make`. */
CELSPAN_CHECKED celspan_status cs_defocus_bands_acquire(celspan_context *context,
                                                        const cs_defocus_bands_key *key,
                                                        cs_defocus_bands_maker make,
                                                        const void *layer, cs_defocus_band **out);
void cs_defocus_bands_release(celspan_context *context, cs_defocus_band *band);
cs_cache_counts cs_defocus_bands_count(celspan_context *context);

#endif
