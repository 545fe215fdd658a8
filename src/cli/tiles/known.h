/* The tiles that are written already, by their pixels: a tile with the same pixels is linked to one
 * of them instead of being written again. Any thread.
 *
 * INVARIANT  What is remembered of a tile is the hash of its coded pixels and where it is in the
 * pyramid; tiles with one hash differ in nothing but their names.
 */
#ifndef CS_CLI_TILES_KNOWN_H
#define CS_CLI_TILES_KNOWN_H

#include <pthread.h>

#include "base/context.h"
#include "base/hash.h"
#include "cli/tiles/pyramid.h"

typedef struct cs_tile_known {
  cs_hash hash; /* 0 0: a free slot */
  cs_pyramid_tile tile;
} cs_tile_known;

typedef struct cs_tile_known_table {
  pthread_mutex_t mutex;
  cs_tile_known *slots; /* 2^n of them, at most half of them used */
  size_t count, capacity;
} cs_tile_known_table;

void cs_tile_known_init(cs_tile_known_table *table);
void cs_tile_known_finish(cs_tile_known_table *table, celspan_context *context);
/* Copies the tile with this hash to *out, if there is one. */
bool cs_tile_known_find(cs_tile_known_table *table, cs_hash hash, cs_tile_known *out);
/* Adds a tile, in the place of one with the same hash. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_tile_known_add(cs_tile_known_table *table,
                                                 celspan_context *context, cs_tile_known tile);

#endif
