#include "relight/original.h"

#include <string.h>

#include "pictures/load.h"
#include "scene/check.h"

celspan_status cs_original_open_picture(celspan_context *context, const cs_picture *picture,
                                        cs_original *out) {
  celspan_picture_info info;
  CS_TRY(cs_store_info(context, picture, &info));
  if ((int64_t)info.width * info.height > CS_ORIGINAL_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: %d x %d pixels are more than can be relit, %d in all; relight parts of it",
                   cs_picture_name(picture), info.width, info.height, CS_ORIGINAL_MOST);
  *out = (cs_original){.picture = picture, .info = info};
  out->rows =
      cs_mem_array(context->memory, (size_t)info.width * CS_ORIGINAL_ROWS, 4 * sizeof *out->rows);
  return out->rows ? CELSPAN_OK : cs_fail_memory(context);
}

celspan_status cs_original_open(celspan_context *context, const char *noun,
                                const celspan_texture *texture, cs_original *out) {
  CS_TRY(cs_check_given(context, noun, "the picture", texture));
  if (texture->kind != CS_TEXTURE_PICTURE || texture->variation->use != CELSPAN_PICTURE_PAINT)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: it takes pictures that are used as paint",
                   noun);
  return cs_original_open_picture(context, texture->variation->picture, out);
}

static celspan_status read_texels(celspan_context *context, cs_original *original, int32_t x) {
  int32_t width = original->info.width, end = cs_original_end(original, original->first);
  int32_t columns = width - x < CS_PICTURE_BLOCK ? width - x : CS_PICTURE_BLOCK;
  cs_picture_block *block;
  CS_TRY(cs_load_block(context, original->picture, 0, x / CS_PICTURE_BLOCK,
                       original->first / CS_PICTURE_BLOCK, &block));
  for (int32_t row = 0; row < end - original->first; row++)
    memcpy(original->rows + 4 * ((size_t)row * (size_t)width + (size_t)x),
           block->texels + 4 * (size_t)row * CS_PICTURE_BLOCK, (size_t)columns * 4 * sizeof(float));
  cs_store_release(block);
  return CELSPAN_OK;
}

celspan_status cs_original_read(celspan_context *context, cs_original *original, int32_t first) {
  original->first = first;
  for (int32_t x = 0; x < original->info.width; x += CS_PICTURE_BLOCK)
    CS_TRY(read_texels(context, original, x));
  return CELSPAN_OK;
}

void cs_original_close(celspan_context *context, cs_original *original) {
  cs_mem_free(context->memory, original->rows,
              (size_t)original->info.width * CS_ORIGINAL_ROWS * 4 * sizeof *original->rows);
  original->rows = NULL;
}

celspan_status cs_original_same_size(celspan_context *context, const cs_original *a,
                                     const cs_original *b) {
  const celspan_picture_info *first = &a->info, *second = &b->info;
  if (first->width == second->width && first->height == second->height)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "relight: %s has %d x %d pixels, and %s %d x %d; they must lie pixel on pixel",
                 cs_picture_name(a->picture), first->width, first->height,
                 cs_picture_name(b->picture), second->width, second->height);
}
