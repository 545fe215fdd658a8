#include "base/arena.h"

#include <string.h>

struct cs_arena_chunk {
  cs_arena_chunk *next;
  size_t size; /* of the bytes behind this header */
  _Alignas(16) unsigned char bytes[];
};

#define CHUNK_SIZE ((size_t)64 << 10)

void cs_arena_init(cs_arena *arena) { *arena = (cs_arena){0}; }

void cs_arena_finish(cs_arena *arena, cs_memory *memory) {
  for (cs_arena_chunk *chunk = arena->first, *next; chunk; chunk = next) {
    next = chunk->next;
    cs_mem_free(memory, chunk, sizeof *chunk + chunk->size);
  }
  *arena = (cs_arena){0};
}

void cs_arena_reset(cs_arena *arena) {
  arena->current = arena->first;
  arena->used = 0;
}

/* The link to the chunk that comes next. */
static cs_arena_chunk **link_of_next(cs_arena *arena) {
  return arena->current ? &arena->current->next : &arena->first;
}

/* Puts a chunk in front of those that come next. */
static cs_arena_chunk *insert_next(cs_arena *arena, cs_arena_chunk *chunk) {
  cs_arena_chunk **link = link_of_next(arena);
  chunk->next = *link;
  *link = chunk;
  return chunk;
}

/* A chunk of at least so many bytes that comes next, brought to the front of them. */
static cs_arena_chunk *find_next(cs_arena *arena, size_t size) {
  for (cs_arena_chunk **link = link_of_next(arena), *chunk; (chunk = *link); link = &chunk->next)
    if (chunk->size >= size) {
      *link = chunk->next;
      return insert_next(arena, chunk);
    }
  return NULL;
}

/* Large chunks have powers of two as sizes: what is a little larger next time fits, too. */
static cs_arena_chunk *make_next(celspan_context *context, cs_arena *arena, size_t size) {
  size_t wanted = CHUNK_SIZE;
  while (wanted < size && wanted <= SIZE_MAX / 4)
    wanted *= 2;
  cs_arena_chunk *chunk = NULL;
  if (wanted >= size)
    chunk = cs_mem_resize(context->memory, NULL, 0, sizeof *chunk + wanted);
  if (!chunk) {
    (void)cs_fail_memory(context);
    return NULL;
  }
  *chunk = (cs_arena_chunk){.size = wanted};
  return insert_next(arena, chunk);
}

void *cs_arena_take(celspan_context *context, cs_arena *arena, size_t size) {
  size = (size + 15) & ~(size_t)15;
  while (!arena->current || arena->current->size - arena->used < size) {
    cs_arena_chunk *next = find_next(arena, size);
    if (!next)
      next = make_next(context, arena, size);
    if (!next)
      return NULL;
    arena->current = next;
    arena->used = 0;
  }
  void *taken = arena->current->bytes + arena->used;
  arena->used += size;
  return taken;
}

void *cs_arena_grow(celspan_context *context, cs_arena *arena, void *items, size_t count,
                    size_t *capacity, size_t size) {
  if (count < *capacity)
    return items;
  size_t wanted = *capacity ? 2 * *capacity : 64;
  void *grown = cs_arena_take(context, arena, wanted * size);
  if (!grown)
    return NULL;
  if (count > 0)
    memcpy(grown, items, count * size);
  *capacity = wanted;
  return grown;
}
