/* The tiles that are written already, by their pixels: a tile with the same pixels is linked to one
 * of them instead of being written again. Any thread.
 *
 * INVARIANT  What is remembered of a tile is the hash of its coded pixels and where it is in the
 * pyramid; tiles with one hash differ in nothing but their names.
 */
#ifndef CS_CLI_TILES_KNOWN_H
#define CS_CLI_TILES_KNOWN_H

#include <pthread.h>

#include "base/hash_table.h"
#include "cli/tiles/pyramid.h"

typedef struct cs_tile_known {
  pthread_mutex_t mutex;
  cs_pyramid_tile *tiles;
  size_t count, capacity;
  cs_hash_table indices; /* from hashes to indices into tiles */
} cs_tile_known;

void cs_tile_known_init(cs_tile_known *known);
void cs_tile_known_finish(cs_tile_known *known, celspan_context *context);
/* Copies the tile with this hash to *out, if there is one. */
bool cs_tile_known_find(cs_tile_known *known, cs_hash hash, cs_pyramid_tile *out);
/* Adds a tile, which replaces one with the same hash. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_tile_known_add(cs_tile_known *known, celspan_context *context,
                                                 cs_hash hash, cs_pyramid_tile tile);

#endif
