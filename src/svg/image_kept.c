#include "svg/image_kept.h"

static cs_hash key_of(const void *element) {
  cs_hash hash = cs_hash_begin(0x696d67u);
  cs_hash_word(&hash, (uint64_t)(uintptr_t)element);
  return cs_hash_end(hash);
}

bool cs_svg_kept_image_find(const cs_svg_kept_images *list, const void *element,
                            cs_svg_kept_image *out) {
  size_t place;
  if (!cs_hash_table_find(&list->places, key_of(element), &place))
    return false;
  *out = list->items[place];
  return true;
}

celspan_status cs_svg_kept_image_add(cs_svg_kept_images *list, celspan_context *context,
                                     const void *element, cs_svg_kept_image image) {
  celspan_status status = cs_mem_reserve(context, (void **)&list->items, &list->capacity,
                                         list->count + 1, sizeof *list->items);
  if (status == CELSPAN_OK)
    status = cs_hash_table_add(&list->places, context, key_of(element), list->count);
  if (status == CELSPAN_OK)
    list->items[list->count++] = image;
  else
    celspan_object_unref(image.object);
  return status;
}

void cs_svg_kept_images_finish(cs_svg_kept_images *list, celspan_context *context) {
  for (size_t i = 0; i < list->count; i++)
    celspan_object_unref(list->items[i].object);
  cs_mem_free(context->memory, list->items, list->capacity * sizeof *list->items);
  cs_hash_table_finish(&list->places, context);
}
