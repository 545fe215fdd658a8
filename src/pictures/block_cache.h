/* Texels by their place, for one thread: blocks stay pinned while they are likely to be asked for
 * again, from run to run and from row to row.
 *
 * Invariant: at most CS_BLOCK_CACHE_SLOTS blocks are pinned. Pairs of slots are found by the
 * block's place, so that neighbours on a row and those that a footprint touches do not fight for
 * one; of a pair the second is the one that was fetched before.
 */
#ifndef CS_PICTURES_BLOCK_CACHE_H
#define CS_PICTURES_BLOCK_CACHE_H

#include "pictures/store.h"

#define CS_BLOCK_CACHE_SLOTS 512

typedef struct cs_block_cache_slot {
  const cs_picture *picture;
  int level;
  int32_t column, row;
  cs_picture_opacity opacity;
  const float *texels;        /* NULL: empty */
  const unsigned char *codes; /* of the texels, where these tell all; else NULL */
  cs_picture_block *block;
} cs_block_cache_slot;

/* What some columns of a picture have in common, on rows from one height to another. */
typedef struct cs_block_cache_opacity {
  const void *sampler; /* of the picture as it lies; NULL: nothing yet */
  int32_t x0, x1;
  double from, to;
  cs_picture_opacity opacity;
} cs_block_cache_opacity;

#define CS_BLOCK_CACHE_OPACITIES 1024

typedef struct cs_block_cache {
  celspan_context *context;
  celspan_status status;       /* of the first block that could not be had; texels are clear then */
  const cs_srgb8_curve *curve; /* of all blocks; NULL until there is one */
  uint32_t fetches;            /* so far */
  uint32_t pairs;              /* in use, a power of two: fewer where memory is short */
  cs_block_cache_slot slots[CS_BLOCK_CACHE_SLOTS];
  cs_block_cache_opacity opacities[CS_BLOCK_CACHE_OPACITIES]; /* the last of each part of a row */
} cs_block_cache;

/* A picture as its texels are asked for. */
typedef struct cs_block_cache_source {
  const cs_picture *picture;
  uint32_t salt; /* spreads the blocks of pictures over the slots */
} cs_block_cache_source;

cs_block_cache_source cs_block_cache_source_of(const cs_picture *picture);

void cs_block_cache_init(cs_block_cache *texels, celspan_context *context);
/* Releases all blocks. */
void cs_block_cache_finish(cs_block_cache *texels);

/* For cs_block_cache_slot_of: into the first of a pair. */
void cs_block_cache_fetch(cs_block_cache *texels, const cs_block_cache_source *source,
                          cs_block_cache_slot *pair, int level, int32_t column, int32_t row);

static inline bool cs_block_cache_is_in(const cs_block_cache_slot *slot,
                                        const cs_block_cache_source *source, int level,
                                        int32_t column, int32_t row) {
  return slot->texels && slot->column == column && slot->row == row && slot->level == level &&
         slot->picture == source->picture;
}

/* A block that exists, valid until another is asked for. Its texels are NULL where it could not be
 * had. */
static inline const cs_block_cache_slot *cs_block_cache_slot_of(cs_block_cache *texels,
                                                                const cs_block_cache_source *source,
                                                                int level, int32_t column,
                                                                int32_t row) {
  uint32_t place = source->salt + (uint32_t)column + 117 * (uint32_t)row + 31 * (uint32_t)level;
  cs_block_cache_slot *pair = &texels->slots[2 * (place & (texels->pairs - 1))];
  if (cs_block_cache_is_in(pair, source, level, column, row))
    return pair;
  if (cs_block_cache_is_in(pair + 1, source, level, column, row))
    return pair + 1;
  cs_block_cache_fetch(texels, source, pair, level, column, row);
  return pair;
}

extern const float cs_block_cache_none[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

/* Its 64 x 64 texels. */
static inline const float *cs_block_cache_block(cs_block_cache *texels,
                                                const cs_block_cache_source *source, int level,
                                                int32_t column, int32_t row) {
  const cs_block_cache_slot *slot = cs_block_cache_slot_of(texels, source, level, column, row);
  return slot->texels ? slot->texels : cs_block_cache_none;
}

/* Texel (x, y) of a level, inside the picture: four floats. */
static inline const float *cs_block_cache_at(cs_block_cache *texels,
                                             const cs_block_cache_source *source, int level,
                                             int32_t x, int32_t y) {
  const float *block =
      cs_block_cache_block(texels, source, level, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK);
  return block + 4 * (y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK + x % CS_PICTURE_BLOCK);
}

#endif
