/* Arrays that a structure owns: each is followed by its room.
 *
 *     CS_ARRAY(cs_cell, cells);        cs_cell *cells;  cs_room cells_room;
 *     CS_ARRAY(cs_item, items);        cs_item *items;  cs_room items_room;
 *
 * So arrays that are neighbours in their structure are measured and freed together, and nobody
 * lists them a second time.
 *
 * Invariant: an array is NULL exactly while its capacity is 0.
 */
#pragma once

#include "base/context.h"

typedef struct cs_room {
  uint32_t capacity;  /* items */
  uint32_t item_size; /* bytes */
} cs_room;

/* Declares an array and its room, both members. They are 0 until the array gets room. */
#define CS_ARRAY(type, name)                                                                       \
  __typeof__(type) *name;                                                                          \
  cs_room name##_room

CELSPAN_CHECKED celspan_status cs_array_grow(celspan_context *context, void **items, cs_room *room,
                                             size_t needed, size_t item_size);
static inline CELSPAN_CHECKED celspan_status cs_array_reserve(celspan_context *context,
                                                              void **items, cs_room *room,
                                                              size_t needed, size_t item_size) {
  return needed <= room->capacity ? CELSPAN_OK
                                  : cs_array_grow(context, items, room, needed, item_size);
}
CELSPAN_CHECKED celspan_status cs_array_fit(celspan_context *context, void **items, cs_room *room,
                                            size_t count, size_t item_size);
CELSPAN_CHECKED celspan_status cs_array_make(celspan_context *context, void **items, cs_room *room,
                                             size_t count, size_t item_size);
void cs_arrays_free(cs_memory *memory, void *first, const void *end);
size_t cs_arrays_bytes(const void *first, const void *end);

/* As CS_RESERVE and CS_APPEND. */
#define CS_ARRAY_RESERVE(context, array, needed)                                                   \
  cs_array_reserve(context, (void **)&(array), &array##_room, needed, sizeof *(array))
#define CS_ARRAY_APPEND(context, array, count, ...)                                                \
  (CS_ARRAY_RESERVE(context, array, (count) + 1) == CELSPAN_OK                                     \
       ? ((array)[(count)++] = (__VA_ARGS__), CELSPAN_OK)                                          \
       : CELSPAN_NO_MEMORY)
/* Makes it an array of exactly `count` items, zeroed; of none it is NULL. What it was is freed.
 * Errors: NO_MEMORY; it is then empty. */
#define CS_ARRAY_MAKE(context, array, count)                                                       \
  cs_array_make(context, (void **)&(array), &array##_room, count, sizeof *(array))
/* Gives it room for exactly `count` items; its contents are kept, further ones are not set. Errors:
 * NO_MEMORY, if it had less room. */
#define CS_ARRAY_FIT(context, array, count)                                                        \
  cs_array_fit(context, (void **)&(array), &array##_room, count, sizeof *(array))
/* Empties all arrays of a structure from `first` to `last`, or counts their bytes. Between the two
 * the structure has nothing but arrays. */
#define CS_ARRAYS_FREE(memory, owner, first, last)                                                 \
  cs_arrays_free(memory, &(owner)->first, &(owner)->last##_room + 1)
#define CS_ARRAYS_BYTES(owner, first, last)                                                        \
  cs_arrays_bytes(&(owner)->first, &(owner)->last##_room + 1)
