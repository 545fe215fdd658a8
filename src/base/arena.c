#include "base/arena.h"

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

static cs_arena_chunk *append_chunk(celspan_context *context, cs_arena *arena, size_t size) {
  size_t wanted = size > CHUNK_SIZE ? size : CHUNK_SIZE;
  cs_arena_chunk *chunk = NULL;
  if (wanted < SIZE_MAX - sizeof *chunk)
    chunk = cs_mem_resize(context->memory, NULL, 0, sizeof *chunk + wanted);
  if (!chunk) {
    (void)cs_fail_memory(context);
    return NULL;
  }
  *chunk = (cs_arena_chunk){.size = wanted};
  if (arena->current) {
    chunk->next = arena->current->next;
    arena->current->next = chunk;
  } else {
    arena->first = chunk;
  }
  return chunk;
}

void *cs_arena_take(celspan_context *context, cs_arena *arena, size_t size) {
  size = (size + 15) & ~(size_t)15;
  while (!arena->current || arena->current->size - arena->used < size) {
    cs_arena_chunk *next = arena->current ? arena->current->next : arena->first;
    if (!next || next->size < size)
      next = append_chunk(context, arena, size);
    if (!next)
      return NULL;
    arena->current = next;
    arena->used = 0;
  }
  void *taken = arena->current->bytes + arena->used;
  arena->used += size;
  return taken;
}
