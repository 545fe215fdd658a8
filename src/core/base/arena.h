/* A stack of memory for the work on one row: pieces of memory that never move and are all freed at
 * once.
 *
 * Invariant: a reset invalidates all memory that was taken before, but does not free it, so that a
 * row allocates from the heap only when it needs more than every row before it.
 */
#pragma once

#include "base/context.h"

typedef struct cs_arena_chunk cs_arena_chunk;

typedef struct cs_arena {
  cs_arena_chunk *first, *current;
  size_t used; /* bytes used in the current chunk */
} cs_arena;

void cs_arena_init(cs_arena *arena);
void cs_arena_finish(cs_arena *arena, cs_memory *memory);
void cs_arena_reset(cs_arena *arena);
/* All bytes that it has allocated. */
size_t cs_arena_bytes(const cs_arena *arena);
/* size bytes, aligned to 16. NULL if there is no memory; the context then has the error. */
void *cs_arena_take(celspan_context *context, cs_arena *arena, size_t size);
/* An array with room for one more than `count` items of `size` bytes: `items`, or a copy of it with
 * twice the capacity, at first 64. NULL when there is no memory; the context then has the error. */
void *cs_arena_grow(celspan_context *context, cs_arena *arena, void *items, size_t count,
                    size_t *capacity, size_t size);
