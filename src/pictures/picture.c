#include "pictures/picture.h"

#include <stdlib.h>
#include <string.h>

#include "colour/transfer.h"

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
