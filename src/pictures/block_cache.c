#include "pictures/block_cache.h"

#include "pictures/load.h"

#define LEAST_PAIRS 16
#define ROWS_AHEAD 4
#define SHARE 8 /* of the memory for pictures, what one thread may pin */

const float cs_block_cache_none[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

cs_block_cache_source cs_block_cache_source_of(const cs_picture *picture) {
  return (cs_block_cache_source){picture, (uint32_t)cs_picture_hash(picture).a};
}

void cs_block_cache_init(cs_block_cache *texels, celspan_context *context) {
  texels->context = context;
  texels->status = CELSPAN_OK;
  texels->fetches = 0;
  texels->pairs = LEAST_PAIRS;
  texels->curve = NULL;
  size_t share = context->root->picture_bytes / SHARE / (2 * CS_PICTURE_BLOCK_BYTES);
  while (texels->pairs < CS_BLOCK_CACHE_SLOTS / 2 && 2 * texels->pairs <= share)
    texels->pairs *= 2;
  for (int i = 0; i < CS_BLOCK_CACHE_SLOTS; i++)
    texels->slots[i].texels = NULL;
  for (int i = 0; i < CS_BLOCK_CACHE_OPACITIES; i++)
    texels->opacities[i].sampler = NULL;
}

static void empty(cs_block_cache_slot *slot) {
  if (slot->texels)
    cs_store_release(slot->block);
  slot->texels = NULL;
}

/* Its first rows, which are read next; those below are fetched while they are. */
static void prefetch_codes(const unsigned char *codes) {
  for (size_t at = 0; at < ROWS_AHEAD * 4 * CS_PICTURE_CODES_ROW; at += 64)
    __builtin_prefetch(codes + at);
}

void cs_block_cache_fetch(cs_block_cache *texels, const cs_block_cache_source *source,
                          cs_block_cache_slot *pair, int level, int32_t column, int32_t row) {
  cs_block_cache_slot *slot = pair;
  texels->fetches++;
  empty(pair + 1);
  pair[1] = pair[0];
  slot->texels = NULL;
  slot->codes = NULL;
  if (texels->status == CELSPAN_OK)
    texels->status =
        cs_load_block(texels->context, source->picture, level, column, row, &slot->block);
  if (texels->status != CELSPAN_OK)
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
  texels->curve = block->entry->curve;
  if (block->is_coded)
    prefetch_codes(slot->codes);
}

void cs_block_cache_finish(cs_block_cache *texels) {
  for (int i = 0; i < CS_BLOCK_CACHE_SLOTS; i++)
    empty(&texels->slots[i]);
}
