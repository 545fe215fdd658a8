#include "model/scene/nearby.h"

#include "model/scene/value.h"

/* ---------------------------------------------------------------- values */

static void hash_light(cs_hash *hash, const cs_nearby_light *light) {
  const double numbers[] = {light->height, light->constant, light->exponent, light->focus,
                            light->cone};
  cs_hash_word(hash, light->source);
  cs_hash_word(hash, light->is_specular);
  cs_hash_numbers(hash, numbers, sizeof numbers / sizeof *numbers);
  cs_hash_numbers(hash, light->colour, 3);
  cs_hash_numbers(hash, light->from, 3);
  cs_hash_numbers(hash, light->towards, 3);
}

static cs_hash hash_nearby(const cs_nearby *nearby) {
  cs_hash hash = cs_hash_begin(CS_VALUE_NEARBY);
  const double numbers[] = {nearby->radius, nearby->amount, nearby->bias};
  const uint64_t words[] = {nearby->kind,
                            nearby->continues,
                            nearby->keeps_alpha,
                            (uint64_t)nearby->size[0],
                            (uint64_t)nearby->size[1],
                            (uint64_t)nearby->target[0],
                            (uint64_t)nearby->target[1]};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    cs_hash_word(&hash, words[i]);
  cs_value_hash_box(&hash, &nearby->box);
  cs_hash_numbers(&hash, numbers, sizeof numbers / sizeof *numbers);
  cs_hash_numbers(&hash, nearby->ground, 3);
  hash_light(&hash, &nearby->light);
  cs_hash_word(&hash, nearby->count);
  for (size_t i = 0; i < nearby->count; i++)
    cs_hash_number(&hash, (double)nearby->numbers[i]);
  return cs_hash_end(hash);
}

celspan_status cs_nearby_create(celspan_context *context, const cs_nearby *fields,
                                cs_nearby **out) {
  cs_nearby *made;
  float *numbers = NULL;
  if (fields->count > 0)
    CS_TRY(CS_MAKE(context, numbers, fields->count));
  made = cs_mem_array(context->memory, 1, sizeof *made);
  if (!made) {
    cs_mem_free(context->memory, numbers, fields->count * sizeof *numbers);
    return cs_fail_memory(context);
  }
  cs_value_copy(made, fields, sizeof *made);
  made->memory = cs_memory_ref(context->memory);
  made->numbers = numbers;
  if (fields->count > 0)
    memcpy(numbers, fields->numbers, fields->count * sizeof *numbers);
  made->hash = hash_nearby(made);
  *out = made;
  return CELSPAN_OK;
}

static void destroy(cs_nearby *nearby) {
  cs_memory *memory = nearby->memory;
  cs_mem_free(memory, (float *)nearby->numbers, nearby->count * sizeof *nearby->numbers);
  cs_counted_free(memory, nearby, sizeof *nearby);
}

CS_COUNTED(cs_nearby)
