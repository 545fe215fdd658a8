#include "base/arrays.h"

#include <assert.h>

#include "base/self_check.h"

/* An array and its room, as CS_ARRAY declares them. */
typedef struct array {
  void *items;
  cs_room room;
} array;
static_assert(sizeof(array) == sizeof(void *) + sizeof(cs_room), "the next array follows the room");

static size_t bytes_of(cs_room room) { return (size_t)room.capacity * room.item_size; }

/* The claim is false if another member lies between the arrays. */
static size_t checked_bytes(const array *at) {
  size_t bytes = bytes_of(at->room);
  CS_SELF_CHECK(!at->items == (bytes == 0));
  return bytes;
}

celspan_status cs_array_grow(celspan_context *context, void **items, cs_room *room, size_t needed,
                             size_t item_size) {
  size_t capacity = room->capacity;
  if (needed > UINT32_MAX / 2)
    return cs_fail_memory(context);
  CS_TRY(cs_mem_grow(context, items, &capacity, needed, item_size));
  *room = (cs_room){(uint32_t)capacity, (uint32_t)item_size};
  return CELSPAN_OK;
}

celspan_status cs_array_fit(celspan_context *context, void **items, cs_room *room, size_t count,
                            size_t item_size) {
  size_t old = bytes_of(*room), size;
  if (count > UINT32_MAX || __builtin_mul_overflow(count, item_size, &size))
    return cs_fail_memory(context);
  void *fitted = *items || size > 0 ? cs_mem_resize(context->memory, *items, old, size) : NULL;
  if (!fitted && size > 0)
    return size <= old ? CELSPAN_OK : cs_fail_memory(context);
  *items = fitted;
  *room = (cs_room){(uint32_t)count, (uint32_t)item_size};
  return CELSPAN_OK;
}

celspan_status cs_array_make(celspan_context *context, void **items, cs_room *room, size_t count,
                             size_t item_size) {
  cs_mem_free(context->memory, *items, bytes_of(*room));
  *items = NULL;
  *room = (cs_room){0};
  if (count == 0)
    return CELSPAN_OK;
  if (count > UINT32_MAX)
    return cs_fail_memory(context);
  CS_TRY(cs_mem_make(context, items, count, item_size));
  *room = (cs_room){(uint32_t)count, (uint32_t)item_size};
  return CELSPAN_OK;
}

void cs_arrays_free(cs_memory *memory, void *first, const void *end) {
  for (array *at = first; (void *)at < end; at++) {
    cs_mem_free(memory, at->items, checked_bytes(at));
    *at = (array){0};
  }
}

size_t cs_arrays_bytes(const void *first, const void *end) {
  size_t bytes = 0;
  for (const array *at = first; (const void *)at < end; at++)
    bytes += checked_bytes(at);
  return bytes;
}
