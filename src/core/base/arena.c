#include "base/arena.h"

#include <string.h>

struct cs_arena_chunk {
  cs_arena_chunk *next;
  size_t size; /* the size of the bytes after this header */
  _Alignas(16) unsigned char bytes[];
};

/* The sizes of chunks with their headers: of the first chunk, and the greatest size up to which
 * each next chunk is larger; later ones are larger only if they must be. Many arenas hold the
 * values of one row, which need little. */
#define CHUNK_FIRST ((size_t)4 << 10)
#define CHUNK_USUAL ((size_t)64 << 10)

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

size_t cs_arena_bytes(const cs_arena *arena) {
  size_t bytes = 0;
  for (const cs_arena_chunk *chunk = arena->first; chunk; chunk = chunk->next)
    bytes += sizeof *chunk + chunk->size;
  return bytes;
}

/* The link to the next chunk. */
static cs_arena_chunk **link_of_next(cs_arena *arena) {
  return arena->current ? &arena->current->next : &arena->first;
}

/* Puts a chunk before the next chunks. */
static cs_arena_chunk *insert_next(cs_arena *arena, cs_arena_chunk *chunk) {
  cs_arena_chunk **link = link_of_next(arena);
  chunk->next = *link;
  *link = chunk;
  return chunk;
}

/* Finds one of the next chunks that has at least `size` bytes, and moves it before the others. */
static cs_arena_chunk *find_next(cs_arena *arena, size_t size) {
  for (cs_arena_chunk **link = link_of_next(arena), *chunk; (chunk = *link); link = &chunk->next)
    if (chunk->size >= size) {
      *link = chunk->next;
      return insert_next(arena, chunk);
    }
  return NULL;
}

/* The size of a new chunk with its header: a power of two, as are the classes of spares
 * (base/spares.h), so that a slightly larger request next time fits, too. 0: no size is large
 * enough. */
static size_t choose_size(const cs_arena *arena, size_t size) {
  size_t wanted = CHUNK_FIRST;
  if (arena->current)
    wanted = 2 * (sizeof(cs_arena_chunk) + arena->current->size);
  wanted = wanted < CHUNK_USUAL ? wanted : CHUNK_USUAL;
  while (wanted - sizeof(cs_arena_chunk) < size && wanted <= SIZE_MAX / 4)
    wanted *= 2;
  return wanted - sizeof(cs_arena_chunk) < size ? 0 : wanted;
}

static cs_arena_chunk *make_next(celspan_context *context, cs_arena *arena, size_t size) {
  size_t wanted = choose_size(arena, size);
  cs_arena_chunk *chunk = NULL;
  if (wanted > 0)
    chunk = cs_mem_resize(context->memory, NULL, 0, wanted);
  if (!chunk) {
    (void)cs_fail_memory(context);
    return NULL;
  }
  *chunk = (cs_arena_chunk){.size = wanted - sizeof *chunk};
  return insert_next(arena, chunk);
}

/* Moves to a chunk that has at least `size` bytes. It is a function of its own, because most calls
 * do not need it and would only save registers for it. */
static __attribute__((noinline)) bool move_on(celspan_context *context, cs_arena *arena,
                                              size_t size) {
  cs_arena_chunk *next = find_next(arena, size);
  if (!next)
    next = make_next(context, arena, size);
  if (!next)
    return false;
  arena->current = next;
  arena->used = 0;
  return true;
}

void *cs_arena_take(celspan_context *context, cs_arena *arena, size_t size) {
  size = (size + 15) & ~(size_t)15;
  bool has_room = arena->current && arena->current->size - arena->used >= size;
  if (!has_room && !move_on(context, arena, size))
    return NULL;
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
