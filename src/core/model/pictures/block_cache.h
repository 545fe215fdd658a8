/* The blocks of pictures that a worker is using. They are pinned in the store as long as they are
 * likely to be needed again, for the next run or the next row, so that most texels are found
 * without a lock.
 *
 *   (picture, level, column, row) --place--> pair of slots  | latest block | the one before |
 *                                                               pinned           pinned
 *
 * INVARIANT: a cache is used by one thread; the blocks in its slots are pinned, two at most for
 * each pair. A pair is chosen by the place of the block in its picture, so that neighbours in a row
 * and the blocks under one footprint do not displace each other.
 */
#pragma once

#include "model/pictures/store.h"

#define CS_BLOCK_CACHE_SLOTS 512

typedef struct cs_block_cache_slot {
  const cs_picture *picture;
  int level;
  int32_t column, row;
  cs_picture_opacity opacity;
  const float *texels;        /* NULL: the slot is empty */
  const unsigned char *codes; /* the codes of the texels; NULL where codes would not be exact */
  cs_picture_block *block;
} cs_block_cache_slot;

/* The opacity of columns [x0, x1) of a picture on the rows from one height to another. */
typedef struct cs_block_cache_opacity {
  const void *sampler; /* identifies the picture and its placement; NULL: empty */
  int32_t x0, x1;
  double from, to;
  cs_picture_opacity opacity;
} cs_block_cache_opacity;

#define CS_BLOCK_CACHE_OPACITIES 1024

typedef struct cs_block_cache {
  celspan_context *context;
  celspan_status status;       /* the first failure; after one, all texels are clear */
  const cs_srgb8_curve *curve; /* the curve of all blocks; NULL before the first one */
  uint32_t fetches;            /* blocks fetched from the store so far */
  uint32_t pairs; /* pairs of slots in use, a power of two; fewer when memory is short */
  cs_block_cache_slot slots[CS_BLOCK_CACHE_SLOTS];
  cs_block_cache_opacity opacities[CS_BLOCK_CACHE_OPACITIES]; /* by place in the row */
} cs_block_cache;

/* A picture as the cache needs to know it. */
typedef struct cs_block_cache_source {
  const cs_picture *picture;
  uint32_t salt; /* spreads the blocks of pictures over the slots */
} cs_block_cache_source;

cs_block_cache_source cs_block_cache_source_of(const cs_picture *picture);

void cs_block_cache_init(cs_block_cache *cache, celspan_context *context);
/* Releases all blocks. */
void cs_block_cache_finish(cs_block_cache *cache);

/* For cs_block_cache_slot_of: fetches a block into the first slot of a pair. */
void cs_block_cache_fetch(cs_block_cache *cache, const cs_block_cache_source *source,
                          cs_block_cache_slot *pair, int level, int32_t column, int32_t row);

static inline bool cs_block_cache_is_in(const cs_block_cache_slot *slot,
                                        const cs_block_cache_source *source, int level,
                                        int32_t column, int32_t row) {
  return slot->texels && slot->column == column && slot->row == row && slot->level == level &&
         slot->picture == source->picture;
}

/* The slot of a block, which must exist in the picture. Valid until the next call. Its texels are
 * NULL when the block could not be loaded. */
static inline const cs_block_cache_slot *cs_block_cache_slot_of(cs_block_cache *cache,
                                                                const cs_block_cache_source *source,
                                                                int level, int32_t column,
                                                                int32_t row) {
  uint32_t place = source->salt + (uint32_t)column + 117 * (uint32_t)row + 31 * (uint32_t)level;
  cs_block_cache_slot *pair = &cache->slots[2 * (place & (cache->pairs - 1))];
  if (cs_block_cache_is_in(pair, source, level, column, row))
    return pair;
  if (cs_block_cache_is_in(pair + 1, source, level, column, row))
    return pair + 1;
  cs_block_cache_fetch(cache, source, pair, level, column, row);
  return pair;
}

/* Clear texels, in place of a block that could not be loaded. */
extern const float cs_block_cache_none[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

/* The 64 x 64 texels of a block. */
static inline const float *cs_block_cache_block(cs_block_cache *cache,
                                                const cs_block_cache_source *source, int level,
                                                int32_t column, int32_t row) {
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(cache, source, level, column, row);
  return slot->texels ? slot->texels : cs_block_cache_none;
}

/* Texel (x, y) of a level, which must lie inside the picture: four floats. */
static inline const float *cs_block_cache_at(cs_block_cache *cache,
                                             const cs_block_cache_source *source, int level,
                                             int32_t x, int32_t y) {
  const float *block =
      cs_block_cache_block(cache, source, level, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK);
  return block + 4 * (y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK + x % CS_PICTURE_BLOCK);
}
