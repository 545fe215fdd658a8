#include "cli/tiles/known.h"

void cs_tile_known_init(cs_tile_known *known) {
  *known = (cs_tile_known){.count = 0};
  pthread_mutex_init(&known->mutex, NULL);
}

void cs_tile_known_finish(cs_tile_known *known, celspan_context *context) {
  cs_mem_free(context->memory, known->tiles, known->capacity * sizeof *known->tiles);
  cs_hash_table_finish(&known->indices, context);
  pthread_mutex_destroy(&known->mutex);
}

bool cs_tile_known_find(cs_tile_known *known, cs_hash hash, cs_pyramid_tile *out) {
  size_t index;
  pthread_mutex_lock(&known->mutex);
  bool is_found = cs_hash_table_find(&known->indices, hash, &index);
  if (is_found)
    *out = known->tiles[index];
  pthread_mutex_unlock(&known->mutex);
  return is_found;
}

/* The mutex is held. */
static celspan_status add(cs_tile_known *known, celspan_context *context, cs_hash hash,
                          cs_pyramid_tile tile) {
  CS_TRY(cs_mem_reserve(context, (void **)&known->tiles, &known->capacity, known->count + 1,
                        sizeof *known->tiles));
  CS_TRY(cs_hash_table_add(&known->indices, context, hash, known->count));
  known->tiles[known->count++] = tile;
  return CELSPAN_OK;
}

celspan_status cs_tile_known_add(cs_tile_known *known, celspan_context *context, cs_hash hash,
                                 cs_pyramid_tile tile) {
  pthread_mutex_lock(&known->mutex);
  celspan_status status = add(known, context, hash, tile);
  pthread_mutex_unlock(&known->mutex);
  return status;
}
