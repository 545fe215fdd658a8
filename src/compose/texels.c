#include "compose/texels.h"

#define LEAST_PAIRS 16
#define SHARE 8 /* of the memory for pictures, what one thread may pin */

const float cs_texels_none[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

cs_texels_source cs_texels_source_of(const cs_picture *picture) {
  return (cs_texels_source){picture, (uint32_t)cs_picture_hash(picture).a};
}

void cs_texels_init(cs_texels *texels, celspan_context *context) {
  texels->context = context;
  texels->status = CELSPAN_OK;
  texels->pairs = LEAST_PAIRS;
  size_t share = context->root->picture_bytes / SHARE / (2 * CS_PICTURE_BLOCK_BYTES);
  while (texels->pairs < CS_TEXELS_SLOTS / 2 && 2 * texels->pairs <= share)
    texels->pairs *= 2;
  for (int i = 0; i < CS_TEXELS_SLOTS; i++)
    texels->slots[i].texels = NULL;
}

static void empty(cs_texels *texels, cs_texels_slot *slot) {
  if (slot->texels)
    cs_picture_release(texels->context, slot->block);
  slot->texels = NULL;
}

void cs_texels_fetch(cs_texels *texels, const cs_texels_source *source, cs_texels_slot *pair,
                     int level, int32_t column, int32_t row) {
  cs_texels_slot *slot = pair;
  empty(texels, pair + 1);
  pair[1] = pair[0];
  slot->texels = NULL;
  if (texels->status == CELSPAN_OK)
    texels->status =
        cs_picture_acquire(texels->context, source->picture, level, column, row, &slot->block);
  if (texels->status != CELSPAN_OK)
    return;
  *slot = (cs_texels_slot){.picture = source->picture,
                           .level = level,
                           .column = column,
                           .row = row,
                           .look = cs_picture_block_look(slot->block),
                           .texels = cs_picture_texels(slot->block),
                           .block = slot->block};
}

void cs_texels_finish(cs_texels *texels) {
  for (int i = 0; i < CS_TEXELS_SLOTS; i++)
    empty(texels, &texels->slots[i]);
}
