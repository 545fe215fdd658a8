/* Texels by their place, for one run of one thread: blocks stay pinned while they are likely to be
 * asked for again.
 *
 * Slots are found by the block's column and row, so that the blocks a footprint touches never fight
 * for one.
 */
#ifndef CS_COMPOSE_TEXELS_H
#define CS_COMPOSE_TEXELS_H

#include "scene/picture.h"

#define CS_TEXELS_ACROSS 8
#define CS_TEXELS_DOWN 4

typedef struct cs_texels_slot {
  int level;
  int32_t column, row;
  const float *texels; /* NULL: empty */
  cs_picture_block *block;
} cs_texels_slot;

typedef struct cs_texels {
  celspan_context *context;
  const cs_picture *picture;
  celspan_status status; /* of the first block that could not be had; texels are clear then */
  cs_texels_slot slots[CS_TEXELS_ACROSS * CS_TEXELS_DOWN];
} cs_texels;

void cs_texels_begin(cs_texels *texels, celspan_context *context, const cs_picture *picture);
/* Releases all blocks and tells whether every one could be had. */
CELSPAN_CHECKED celspan_status cs_texels_end(cs_texels *texels);

/* For cs_texels_block. */
const float *cs_texels_fetch(cs_texels *texels, cs_texels_slot *slot, int level, int32_t column,
                             int32_t row);

/* The 64 x 64 texels of a block that exists. */
static inline const float *cs_texels_block(cs_texels *texels, int level, int32_t column,
                                           int32_t row) {
  cs_texels_slot *slot = &texels->slots[(row & (CS_TEXELS_DOWN - 1)) * CS_TEXELS_ACROSS +
                                        (column & (CS_TEXELS_ACROSS - 1))];
  if (slot->texels && slot->column == column && slot->row == row && slot->level == level)
    return slot->texels;
  return cs_texels_fetch(texels, slot, level, column, row);
}

/* Texel (x, y) of a level, inside the picture: four floats. */
static inline const float *cs_texels_at(cs_texels *texels, int level, int32_t x, int32_t y) {
  const float *block = cs_texels_block(texels, level, x / CS_PICTURE_BLOCK, y / CS_PICTURE_BLOCK);
  return block + 4 * (y % CS_PICTURE_BLOCK * CS_PICTURE_BLOCK + x % CS_PICTURE_BLOCK);
}

#endif
