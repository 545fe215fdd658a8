#include "compose/texels.h"

static const float nothing[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];

void cs_texels_begin(cs_texels *texels, celspan_context *context, const cs_picture *picture) {
  texels->context = context;
  texels->picture = picture;
  texels->status = CELSPAN_OK;
  for (int i = 0; i < CS_TEXELS_ACROSS * CS_TEXELS_DOWN; i++)
    texels->slots[i].texels = NULL;
}

static void empty(cs_texels *texels, cs_texels_slot *slot) {
  if (slot->texels && slot->texels != nothing)
    cs_picture_release(texels->context, slot->block);
  slot->texels = NULL;
}

const float *cs_texels_fetch(cs_texels *texels, cs_texels_slot *slot, int level, int32_t column,
                             int32_t row) {
  empty(texels, slot);
  celspan_status status = texels->status;
  if (status == CELSPAN_OK)
    status = cs_picture_acquire(texels->context, texels->picture, level, column, row, &slot->block);
  texels->status = status;
  slot->level = level;
  slot->column = column;
  slot->row = row;
  slot->texels = status == CELSPAN_OK ? cs_picture_texels(slot->block) : nothing;
  return slot->texels;
}

celspan_status cs_texels_end(cs_texels *texels) {
  for (int i = 0; i < CS_TEXELS_ACROSS * CS_TEXELS_DOWN; i++)
    empty(texels, &texels->slots[i]);
  return texels->status;
}
