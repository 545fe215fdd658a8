/* The cache of maps, kept from frame to frame.
 *
 *   frame 1 --acquire (drawing, scale)--> made ---\
 *   frame 2 --acquire (drawing, scale)--> found ---+--> one map of the cache
 *
 * A context has one such cache, which all its threads and frames share. The key of a map contains
 * a hash of everything that it depends on. The invariants of base/cache.h hold.
 */
#pragma once

#include "base/cache.h"
#include "engine/map/map.h"

/* Fills an empty map. */
typedef celspan_status (*cs_map_keep_maker)(void *user, celspan_context *context, cs_map *map);

/* What is done with a new map: it is dropped with its frame, or kept if there is room, or kept in
 * place of other maps. */
typedef enum cs_map_keeping {
  CS_MAP_KEEP_NOT,
  CS_MAP_KEEP_BESIDE,
  CS_MAP_KEEP_FIRST
} cs_map_keeping;

/* Finds a map, or makes it by calling make(user, ...). *out: a reference. Any thread. Errors:
 * NO_MEMORY and those of `make`. */
CELSPAN_CHECKED celspan_status cs_map_keep_acquire(celspan_context *context, cs_cache_key key,
                                                   cs_map_keeping keeping, cs_map_keep_maker make,
                                                   void *user, cs_map **out);
cs_cache_counts cs_map_keep_count(celspan_context *context);
