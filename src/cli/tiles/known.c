#include "cli/tiles/known.h"

enum { SLOTS_LEAST = 1024 };

static bool is_free(const cs_tile_known *slot) { return !slot->hash.a && !slot->hash.b; }

void cs_tile_known_init(cs_tile_known_table *table) {
  *table = (cs_tile_known_table){.count = 0};
  pthread_mutex_init(&table->mutex, NULL);
}

void cs_tile_known_finish(cs_tile_known_table *table, celspan_context *context) {
  cs_mem_free(context->memory, table->slots, table->capacity * sizeof *table->slots);
  pthread_mutex_destroy(&table->mutex);
}

/* The slot of a hash, or the free one where it belongs. */
static cs_tile_known *slot_of(cs_tile_known *slots, size_t capacity, cs_hash hash) {
  size_t i = (size_t)hash.a & (capacity - 1);
  while (!is_free(&slots[i]) && (slots[i].hash.a != hash.a || slots[i].hash.b != hash.b))
    i = (i + 1) & (capacity - 1);
  return &slots[i];
}

static celspan_status grow(cs_tile_known_table *table, celspan_context *context) {
  size_t capacity = table->capacity ? 2 * table->capacity : SLOTS_LEAST;
  cs_tile_known *slots = cs_mem_array(context->memory, capacity, sizeof *slots);
  if (!slots)
    return cs_fail_memory(context);
  for (size_t i = 0; i < table->capacity; i++)
    if (!is_free(&table->slots[i]))
      *slot_of(slots, capacity, table->slots[i].hash) = table->slots[i];
  cs_mem_free(context->memory, table->slots, table->capacity * sizeof *slots);
  table->slots = slots;
  table->capacity = capacity;
  return CELSPAN_OK;
}

bool cs_tile_known_find(cs_tile_known_table *table, cs_hash hash, cs_tile_known *out) {
  pthread_mutex_lock(&table->mutex);
  const cs_tile_known *slot = table->slots ? slot_of(table->slots, table->capacity, hash) : NULL;
  bool is_found = slot && !is_free(slot);
  if (is_found)
    *out = *slot;
  pthread_mutex_unlock(&table->mutex);
  return is_found;
}

celspan_status cs_tile_known_add(cs_tile_known_table *table, celspan_context *context,
                                 cs_tile_known tile) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&table->mutex);
  if (2 * table->count >= table->capacity)
    status = grow(table, context);
  if (status == CELSPAN_OK) {
    cs_tile_known *slot = slot_of(table->slots, table->capacity, tile.hash);
    table->count += is_free(slot);
    *slot = tile;
  }
  pthread_mutex_unlock(&table->mutex);
  return status;
}
