#include "base/hash_table.h"

enum { SLOTS_LEAST = 64 };

/* The slot of a key, or the free slot in which it can be put. */
static cs_hash_slot *slot_of(const cs_hash_table *table, cs_hash key) {
  size_t i = (size_t)key.a & (table->slot_count - 1);
  while (table->slots[i].number > 0 &&
         (table->slots[i].key.a != key.a || table->slots[i].key.b != key.b))
    i = (i + 1) & (table->slot_count - 1);
  return &table->slots[i];
}

static celspan_status grow(cs_hash_table *table, celspan_context *context) {
  cs_hash_table grown = {.slot_count = table->slots ? 2 * table->slot_count : SLOTS_LEAST,
                         .count = table->count};
  CS_TRY(CS_MAKE(context, grown.slots, grown.slot_count));
  for (size_t i = 0; i < table->slot_count; i++)
    if (table->slots[i].number > 0)
      *slot_of(&grown, table->slots[i].key) = table->slots[i];
  cs_hash_table_finish(table, context);
  *table = grown;
  return CELSPAN_OK;
}

bool cs_hash_table_find(const cs_hash_table *table, cs_hash key, size_t *number) {
  const cs_hash_slot *slot = table->slots ? slot_of(table, key) : NULL;
  if (!slot || slot->number == 0)
    return false;
  *number = slot->number - 1;
  return true;
}

celspan_status cs_hash_table_add(cs_hash_table *table, celspan_context *context, cs_hash key,
                                 size_t number) {
  if (2 * (table->count + 1) > table->slot_count)
    CS_TRY(grow(table, context));
  cs_hash_slot *slot = slot_of(table, key);
  table->count += slot->number == 0;
  *slot = (cs_hash_slot){key, number + 1};
  return CELSPAN_OK;
}

void cs_hash_table_finish(cs_hash_table *table, celspan_context *context) {
  cs_mem_free(context->memory, table->slots, table->slot_count * sizeof *table->slots);
  *table = (cs_hash_table){.count = 0};
}
