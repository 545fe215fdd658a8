#include "film/duplicates.h"

celspan_status cs_duplicates_add(cs_duplicates *duplicates, celspan_context *context, cs_hash scene,
                                 int64_t number, size_t *index, bool *is_new) {
  *is_new = !cs_hash_table_find(&duplicates->indices, scene, index);
  if (!*is_new)
    return CELSPAN_OK;
  CS_TRY(cs_mem_reserve(context, (void **)&duplicates->known, &duplicates->capacity,
                        duplicates->count + 1, sizeof *duplicates->known));
  CS_TRY(cs_hash_table_add(&duplicates->indices, context, scene, duplicates->count));
  *index = duplicates->count++;
  duplicates->known[*index] = (cs_duplicate){.number = number};
  return CELSPAN_OK;
}

void cs_duplicates_finish(cs_duplicates *duplicates, celspan_context *context) {
  cs_mem_free(context->memory, duplicates->known, duplicates->capacity * sizeof *duplicates->known);
  cs_hash_table_finish(&duplicates->indices, context);
  *duplicates = (cs_duplicates){0};
}
