#include "film/duplicates.h"

enum { PLACES_LEAST = 64 };

/* The place of a scene, or the free one where it belongs. */
static size_t *place_of(const cs_duplicates *duplicates, cs_hash scene) {
  size_t i = (size_t)scene.a & (duplicates->place_count - 1);
  while (duplicates->places[i]) {
    const cs_hash *there = &duplicates->known[duplicates->places[i] - 1].scene;
    if (there->a == scene.a && there->b == scene.b)
      break;
    i = (i + 1) & (duplicates->place_count - 1);
  }
  return &duplicates->places[i];
}

static celspan_status grow(cs_duplicates *duplicates, celspan_context *context) {
  size_t count = duplicates->place_count ? 2 * duplicates->place_count : PLACES_LEAST;
  size_t *places = cs_mem_array(context->memory, count, sizeof *places);
  if (!places)
    return cs_fail_memory(context);
  cs_mem_free(context->memory, duplicates->places, duplicates->place_count * sizeof *places);
  duplicates->places = places;
  duplicates->place_count = count;
  for (size_t i = 0; i < duplicates->count; i++)
    *place_of(duplicates, duplicates->known[i].scene) = i + 1;
  return CELSPAN_OK;
}

celspan_status cs_duplicates_meet(cs_duplicates *duplicates, celspan_context *context,
                                  cs_hash scene, int64_t number, size_t *index, bool *is_new) {
  if (2 * (duplicates->count + 1) > duplicates->place_count)
    CS_TRY(grow(duplicates, context));
  size_t *place = place_of(duplicates, scene);
  *is_new = *place == 0;
  if (*is_new) {
    CS_TRY(cs_mem_reserve(context, (void **)&duplicates->known, &duplicates->capacity,
                          duplicates->count + 1, sizeof *duplicates->known));
    duplicates->known[duplicates->count] = (cs_duplicate){.scene = scene, .number = number};
    *place = ++duplicates->count;
  }
  *index = *place - 1;
  return CELSPAN_OK;
}

void cs_duplicates_finish(cs_duplicates *duplicates, celspan_context *context) {
  cs_mem_free(context->memory, duplicates->known, duplicates->capacity * sizeof *duplicates->known);
  cs_mem_free(context->memory, duplicates->places,
              duplicates->place_count * sizeof *duplicates->places);
  *duplicates = (cs_duplicates){0};
}
