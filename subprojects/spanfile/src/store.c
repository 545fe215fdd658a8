#include "store.h"

#include <stdlib.h>

static void *resize_by_library(void *user, void *block, size_t old_size, size_t new_size) {
  (void)user;
  (void)old_size;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

sf_memory sf_memory_of(spanfile_resize resize, void *user) {
  return (sf_memory){resize ? resize : resize_by_library, user};
}

void *sf_allocate(const sf_memory *memory, size_t size) {
  return memory->resize(memory->user, NULL, 0, size);
}

void sf_release(const sf_memory *memory, void *block, size_t size) {
  if (block)
    (void)memory->resize(memory->user, block, size, 0);
}

/* At least `needed` items of item_size bytes, and at least half as many again as before. */
static void *grow(const sf_memory *memory, void *items, size_t *capacity, size_t needed,
                  size_t item_size) {
  size_t wanted = *capacity + *capacity / 2;
  wanted = wanted < needed ? needed : wanted;
  wanted = wanted * item_size < 256 ? 256 / item_size : wanted;
  if (wanted > SIZE_MAX / 2 / item_size)
    return NULL;
  void *grown = memory->resize(memory->user, items, *capacity * item_size, wanted * item_size);
  if (grown)
    *capacity = wanted;
  return grown;
}

bool sf_bytes_grow(const sf_memory *memory, sf_bytes *bytes, size_t more) {
  if (more > SIZE_MAX / 4 - bytes->size)
    return false;
  void *grown = grow(memory, bytes->at, &bytes->capacity, bytes->size + more, 1);
  if (grown)
    bytes->at = grown;
  return grown != NULL;
}

void sf_bytes_free(const sf_memory *memory, sf_bytes *bytes) {
  sf_release(memory, bytes->at, bytes->capacity);
  *bytes = (sf_bytes){0};
}

bool sf_row_grow(const sf_memory *memory, sf_row *row) {
  void *grown = grow(memory, row->spans, &row->capacity, row->count + 1, sizeof *row->spans);
  if (grown)
    row->spans = grown;
  return grown != NULL;
}

void sf_row_clear(sf_row *row) {
  row->count = 0;
  row->values.size = 0;
}

void sf_row_free(const sf_memory *memory, sf_row *row) {
  sf_release(memory, row->spans, row->capacity * sizeof *row->spans);
  sf_bytes_free(memory, &row->values);
  *row = (sf_row){0};
}
