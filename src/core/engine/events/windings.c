/* Windings. At every place of a drawing, the outline of each layer winds a number of times around
 * this place. The list of these numbers, one per layer, is a winding. A drawing has at most as many
 * different windings as it has faces, and each winding gets a number.
 *
 *        0  |  1 = 0 and A  |  2 = 1 and B    |  1        a boundary that is crossed from left to
 *           a               b                 c           right leads from one winding to another
 *
 *     0 ---a--- 1 ---b--- 2        every winding but the first stores from which winding, and over
 *                                  which boundary, it was first reached. This makes a tree, so
 *                                  that a walk through all windings crosses few boundaries
 *
 * A winding is found again by its hash, which is a sum over the layers, so that it does not depend
 * on the order in which boundaries are crossed. The hash has two sums of 64 bits each, so that two
 * windings with the same hash are not expected in practice.
 */
#include "engine/events/bundle.h"

#include "base/splitmix.h"

#define SLOTS_LEAST 1024

cs_windings_hash cs_windings_add(cs_windings_hash hash, uint32_t layer, int32_t direction) {
  uint64_t name = layer, a = cs_splitmix_next(&name), b = cs_splitmix_next(&name);
  return direction > 0 ? (cs_windings_hash){hash.a + a, hash.b + b}
                       : (cs_windings_hash){hash.a - a, hash.b - b};
}

/* The slot of a hash: the slot that contains its number, or a free one. */
static size_t find_slot(const cs_windings *w, cs_windings_hash hash) {
  size_t at = hash.a & (w->slots_room.capacity - 1);
  for (; w->slots[at]; at = (at + 1) & (w->slots_room.capacity - 1)) {
    const cs_windings_hash *found = &w->entries[w->slots[at] - 1].hash;
    if (found->a == hash.a && found->b == hash.b)
      break;
  }
  return at;
}

static celspan_status widen_slots(celspan_context *context, cs_windings *w) {
  size_t count = 2 * (size_t)w->slots_room.capacity;
  CS_TRY(CS_ARRAY_MAKE(context, w->slots, count > 0 ? count : SLOTS_LEAST));
  for (size_t i = 0; i < w->count; i++)
    w->slots[find_slot(w, w->entries[i].hash)] = (uint32_t)i + 1;
  return CELSPAN_OK;
}

celspan_status cs_windings_init(celspan_context *context, cs_windings *w) {
  *w = (cs_windings){0};
  CS_TRY(CS_ARRAY_APPEND(context, w->entries, w->count, (cs_windings_entry){.boundary = 0}));
  return widen_slots(context, w);
}

void cs_windings_finish(cs_windings *w, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, w, entries, slots);
  *w = (cs_windings){0};
}

celspan_status cs_windings_cross(celspan_context *context, cs_windings *w, uint32_t from,
                                 uint32_t boundary, cs_windings_hash change, uint32_t *out) {
  cs_windings_hash hash = w->entries[from].hash;
  hash.a += change.a;
  hash.b += change.b;
  size_t at = find_slot(w, hash);
  if (w->slots[at]) {
    *out = w->slots[at] - 1;
    return CELSPAN_OK;
  }
  *out = (uint32_t)w->count;
  const cs_windings_entry entry = {hash, from, boundary, 0};
  CS_TRY(CS_ARRAY_APPEND(context, w->entries, w->count, entry));
  w->slots[at] = *out + 1;
  return 2 * w->count > w->slots_room.capacity ? widen_slots(context, w) : CELSPAN_OK;
}
