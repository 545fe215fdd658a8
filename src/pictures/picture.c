#include "pictures/picture.h"

#include <stdlib.h>
#include <string.h>

#include "colour/transfer.h"
#include "pictures/store.h"

/* ---------------------------------------------------------------- the value */

static char *copy_text(cs_memory *memory, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = cs_mem_resize(memory, NULL, 0, size);
  return copy ? memcpy(copy, text, size) : NULL;
}

static void free_text(cs_memory *memory, char *text) {
  if (text)
    cs_mem_free(memory, text, strlen(text) + 1);
}

static cs_hash hash_of(const celspan_picture_desc *desc) {
  cs_hash hash = cs_hash_begin(0x70696374u);
  cs_hash_text(&hash, desc->file);
  cs_hash_text(&hash, desc->colour);
  cs_hash_text(&hash, desc->layer);
  cs_hash_word(&hash, (uint64_t)(desc->layer ? 0 : desc->subimage));
  return cs_hash_end(hash);
}

static celspan_status check(celspan_context *context, const celspan_picture_desc *desc) {
  celspan_transfer transfer;
  if (!desc->file || !*desc->file)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "picture: file must name a file");
  if (desc->subimage < 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "picture: subimage is %d; it must be 0 or more",
                   desc->subimage);
  if (desc->colour && !cs_transfer_parse(desc->colour, &transfer) && !getenv("OCIO"))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "picture: colour is \"%s\"; it must be \"srgb\", \"linear\", \"rec709\", "
                   "\"cineon\", or a space of the OpenColorIO configuration that the environment "
                   "variable OCIO names",
                   desc->colour);
  return CELSPAN_OK;
}

celspan_status cs_picture_create(celspan_context *context, const celspan_picture_desc *desc,
                                 cs_picture **out) {
  CS_TRY(check(context, desc));
  cs_picture *picture = cs_mem_array(context->memory, 1, sizeof *picture);
  if (!picture)
    return cs_fail_memory(context);
  atomic_init(&picture->references, 1);
  picture->memory = cs_memory_ref(context->memory);
  picture->hash = hash_of(desc);
  picture->subimage = desc->layer ? 0 : desc->subimage;
  picture->file = copy_text(picture->memory, desc->file);
  picture->colour = desc->colour ? copy_text(picture->memory, desc->colour) : NULL;
  picture->layer = desc->layer ? copy_text(picture->memory, desc->layer) : NULL;
  if (!picture->file || !picture->colour != !desc->colour || !picture->layer != !desc->layer) {
    cs_picture_unref(picture);
    return cs_fail_memory(context);
  }
  *out = picture;
  return CELSPAN_OK;
}

cs_picture *cs_picture_ref(cs_picture *picture) {
  atomic_fetch_add_explicit(&picture->references, 1, memory_order_relaxed);
  return picture;
}

void cs_picture_unref(cs_picture *picture) {
  if (!picture || atomic_fetch_sub_explicit(&picture->references, 1, memory_order_acq_rel) != 1)
    return;
  cs_memory *memory = picture->memory;
  free_text(memory, picture->file);
  free_text(memory, picture->colour);
  free_text(memory, picture->layer);
  cs_mem_free(memory, picture, sizeof *picture);
  cs_memory_unref(memory);
}

cs_hash cs_picture_hash(const cs_picture *picture) { return picture->hash; }

/* ---------------------------------------------------------------- what is read of it */

celspan_status cs_picture_info(celspan_context *context, const cs_picture *picture,
                               celspan_picture_info *out) {
  cs_picture_store *store;
  cs_picture_entry *entry;
  CS_TRY(cs_store_get(context, &store));
  CS_TRY(cs_store_entry(context, store, picture, &entry));
  *out = entry->header.info;
  return CELSPAN_OK;
}

celspan_status celspan_picture_inspect(celspan_context *context, const celspan_picture_desc *desc,
                                       celspan_picture_info *out) {
  cs_picture *picture;
  CS_TRY(cs_picture_create(context, desc, &picture));
  celspan_status status = cs_picture_info(context, picture, out);
  cs_picture_unref(picture);
  return status;
}

static bool is_inside(const cs_picture_entry *entry, int level, int32_t column, int32_t row) {
  if (level < 0 || level >= entry->level_count || column < 0 || row < 0)
    return false;
  return column <= (cs_levels_size(entry->header.info.width, level) - 1) / CS_PICTURE_BLOCK &&
         row <= (cs_levels_size(entry->header.info.height, level) - 1) / CS_PICTURE_BLOCK;
}

celspan_status cs_picture_acquire(celspan_context *context, const cs_picture *picture, int level,
                                  int32_t column, int32_t row, cs_picture_block **out) {
  cs_picture_store *store;
  cs_picture_entry *entry;
  CS_TRY(cs_store_get(context, &store));
  CS_TRY(cs_store_entry(context, store, picture, &entry));
  if (!is_inside(entry, level, column, row))
    return cs_fail(context, CELSPAN_INTERNAL, "%s: block %d, %d of level %d does not exist",
                   picture->file, (int)column, (int)row, level);
  cs_picture_block *block = cs_store_pin(store, entry, level, column, row);
  celspan_status status = CELSPAN_OK;
  if (!block) {
    pthread_mutex_lock(&entry->reading);
    status = cs_load_block(context, store, entry, level, column, row, &block);
    pthread_mutex_unlock(&entry->reading);
  }
  if (status == CELSPAN_OK)
    *out = block;
  return status;
}

const float *cs_picture_texels(const cs_picture_block *block) { return block->texels; }

cs_picture_opacity cs_picture_block_opacity(const cs_picture_block *block) { return block->look; }

const unsigned char *cs_picture_codes(const cs_picture_block *block) { return block->codes[0]; }

bool cs_picture_is_coded(const cs_picture_block *block) { return block->is_coded; }

const cs_srgb8_curve *cs_picture_curve(const cs_picture_block *block) {
  return block->entry->curve;
}

void cs_picture_release(celspan_context *context, cs_picture_block *block) {
  cs_store_unpin((cs_picture_store *)context->root->pictures, block);
}
