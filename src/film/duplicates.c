#include "film/duplicates.h"

enum { SLOTS_LEAST = 64 };

/* The slot of a scene, or the free one where it belongs. */
static size_t *slot_of(const cs_duplicates *duplicates, cs_hash scene) {
  size_t i = (size_t)scene.a & (duplicates->slot_count - 1);
  while (duplicates->slots[i]) {
    const cs_hash *there = &duplicates->known[duplicates->slots[i] - 1].scene;
    if (there->a == scene.a && there->b == scene.b)
      break;
    i = (i + 1) & (duplicates->slot_count - 1);
  }
  return &duplicates->slots[i];
}

static celspan_status grow(cs_duplicates *duplicates, celspan_context *context) {
  size_t count = duplicates->slot_count ? 2 * duplicates->slot_count : SLOTS_LEAST;
  size_t *slots = cs_mem_array(context->memory, count, sizeof *slots);
  if (!slots)
    return cs_fail_memory(context);
  cs_mem_free(context->memory, duplicates->slots, duplicates->slot_count * sizeof *slots);
  duplicates->slots = slots;
  duplicates->slot_count = count;
  for (size_t i = 0; i < duplicates->count; i++)
    *slot_of(duplicates, duplicates->known[i].scene) = i + 1;
  return CELSPAN_OK;
}

celspan_status cs_duplicates_add(cs_duplicates *duplicates, celspan_context *context, cs_hash scene,
                                 int64_t number, size_t *index, bool *is_new) {
  if (2 * (duplicates->count + 1) > duplicates->slot_count)
    CS_TRY(grow(duplicates, context));
  size_t *slot = slot_of(duplicates, scene);
  *is_new = *slot == 0;
  if (*is_new) {
    CS_TRY(cs_mem_reserve(context, (void **)&duplicates->known, &duplicates->capacity,
                          duplicates->count + 1, sizeof *duplicates->known));
    duplicates->known[duplicates->count] = (cs_duplicate){.scene = scene, .number = number};
    *slot = ++duplicates->count;
  }
  *index = *slot - 1;
  return CELSPAN_OK;
}

void cs_duplicates_finish(cs_duplicates *duplicates, celspan_context *context) {
  cs_mem_free(context->memory, duplicates->known, duplicates->capacity * sizeof *duplicates->known);
  cs_mem_free(context->memory, duplicates->slots,
              duplicates->slot_count * sizeof *duplicates->slots);
  *duplicates = (cs_duplicates){0};
}
