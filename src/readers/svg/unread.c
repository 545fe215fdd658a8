#include "readers/svg/unread.h"

#include <stdio.h>

#define TEXT 120 /* bytes of an entry */

static cs_hash hash_name(const char *name) {
  cs_hash hash = cs_hash_begin(0x756e7265u);
  cs_hash_text(&hash, name);
  return cs_hash_end(hash);
}

/* The beginning of a value, with its end cut off after a whole character. */
static int shown_size(const char *value, size_t most) {
  size_t size = 0;
  while (value[size] && size < most)
    size++;
  while (value[size] && size > 0 && ((unsigned char)value[size] & 0xc0) == 0x80)
    size--;
  return (int)size;
}

celspan_status cs_svg_unread_add(cs_svg_unread *list, celspan_context *context, cs_arena *arena,
                                 uint32_t line, const char *name, const char *value) {
  size_t there;
  if (list->count == CS_SVG_UNREAD || cs_hash_table_find(&list->names, hash_name(name), &there))
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(context, (void **)&list->items, &list->capacity, list->count + 1,
                        sizeof *list->items));
  char *text = cs_arena_take(context, arena, TEXT);
  if (!text)
    return CELSPAN_NO_MEMORY;
  if (value)
    snprintf(text, TEXT, "%.*s \"%.*s\"", shown_size(name, 40), name, shown_size(value, 60), value);
  else
    snprintf(text, TEXT, "%.*s", shown_size(name, 60), name);
  CS_TRY(cs_hash_table_add(&list->names, context, hash_name(name), list->count));
  list->items[list->count++] = (cs_svg_unread_name){text, line};
  return CELSPAN_OK;
}

void cs_svg_unread_finish(cs_svg_unread *list, celspan_context *context) {
  cs_mem_free(context->memory, list->items, list->capacity * sizeof *list->items);
  cs_hash_table_finish(&list->names, context);
  *list = (cs_svg_unread){0};
}
