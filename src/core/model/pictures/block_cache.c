#include "model/pictures/block_cache.h"

#include "model/pictures/load.h"

#define LEAST_PAIRS 16
#define ROWS_AHEAD 4
#define SHARE 8 /* a cache may pin one part in SHARE of the memory for pictures */

const float cs_block_cache_none[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

cs_block_cache_source cs_block_cache_source_of(const cs_picture *picture) {
  return (cs_block_cache_source){picture, (uint32_t)cs_picture_hash(picture).a};
}

void cs_block_cache_init(cs_block_cache *cache, celspan_context *context) {
  cache->context = context;
  cache->status = CELSPAN_OK;
  cache->fetches = 0;
  cache->pairs = LEAST_PAIRS;
  cache->curve = NULL;
  size_t share = context->root->picture_bytes / SHARE / (2 * CS_PICTURE_BLOCK_BYTES);
  while (cache->pairs < CS_BLOCK_CACHE_SLOTS / 2 && 2 * cache->pairs <= share)
    cache->pairs *= 2;
  for (int i = 0; i < CS_BLOCK_CACHE_SLOTS; i++)
    cache->slots[i].texels = NULL;
  for (int i = 0; i < CS_BLOCK_CACHE_OPACITIES; i++)
    cache->opacities[i].sampler = NULL;
}

static void empty(cs_block_cache_slot *slot) {
  if (slot->texels)
    cs_store_release(slot->block);
  slot->texels = NULL;
}

/* The first rows of a block, which are read next. The processor itself notices the pattern and
 * fetches the rows below. */
static void prefetch_codes(const unsigned char *codes) {
  for (size_t at = 0; at < ROWS_AHEAD * 4 * CS_PICTURE_CODES_ROW; at += 64)
    __builtin_prefetch(codes + at);
}

void cs_block_cache_fetch(cs_block_cache *cache, const cs_block_cache_source *source,
                          cs_block_cache_slot *pair, int level, int32_t column, int32_t row) {
  cs_block_cache_slot *slot = pair;
  cache->fetches++;
  empty(pair + 1);
  pair[1] = pair[0];
  slot->texels = NULL;
  slot->codes = NULL;
  if (cache->status == CELSPAN_OK)
    cache->status =
        cs_load_block(cache->context, source->picture, level, column, row, &slot->block);
  if (cache->status != CELSPAN_OK)
    return;
  const cs_picture_block *block = slot->block;
  *slot = (cs_block_cache_slot){.picture = source->picture,
                                .level = level,
                                .column = column,
                                .row = row,
                                .opacity = block->opacity,
                                .texels = block->texels,
                                .codes = block->is_coded ? block->codes[0] : NULL,
                                .block = slot->block};
  cache->curve = &block->store->curve;
  if (block->is_coded)
    prefetch_codes(slot->codes);
}

void cs_block_cache_finish(cs_block_cache *cache) {
  for (int i = 0; i < CS_BLOCK_CACHE_SLOTS; i++)
    empty(&cache->slots[i]);
}
