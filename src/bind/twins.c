#include "bind/twins.h"

enum { PLACES_LEAST = 64 };

/* The place of a scene, or the free one where it belongs. */
static size_t *place_of(const cs_twins *twins, cs_hash scene) {
  size_t i = (size_t)scene.a & (twins->place_count - 1);
  while (twins->places[i]) {
    const cs_hash *there = &twins->known[twins->places[i] - 1].scene;
    if (there->a == scene.a && there->b == scene.b)
      break;
    i = (i + 1) & (twins->place_count - 1);
  }
  return &twins->places[i];
}

static celspan_status grow(cs_twins *twins, celspan_context *context) {
  size_t count = twins->place_count ? 2 * twins->place_count : PLACES_LEAST;
  size_t *places = cs_mem_array(context->memory, count, sizeof *places);
  if (!places)
    return cs_fail_memory(context);
  cs_mem_free(context->memory, twins->places, twins->place_count * sizeof *places);
  twins->places = places;
  twins->place_count = count;
  for (size_t i = 0; i < twins->count; i++)
    *place_of(twins, twins->known[i].scene) = i + 1;
  return CELSPAN_OK;
}

celspan_status cs_twins_meet(cs_twins *twins, celspan_context *context, cs_hash scene,
                             int64_t number, size_t *index, bool *is_new) {
  if (2 * (twins->count + 1) > twins->place_count)
    CS_TRY(grow(twins, context));
  size_t *place = place_of(twins, scene);
  *is_new = *place == 0;
  if (*is_new) {
    CS_TRY(cs_mem_reserve(context, (void **)&twins->known, &twins->capacity, twins->count + 1,
                          sizeof *twins->known));
    twins->known[twins->count] = (cs_twin){.scene = scene, .number = number};
    *place = ++twins->count;
  }
  *index = *place - 1;
  return CELSPAN_OK;
}

void cs_twins_finish(cs_twins *twins, celspan_context *context) {
  cs_mem_free(context->memory, twins->known, twins->capacity * sizeof *twins->known);
  cs_mem_free(context->memory, twins->places, twins->place_count * sizeof *twins->places);
  *twins = (cs_twins){0};
}
