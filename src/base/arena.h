/* A stack of memory for one row's work: blocks that never move and are all given back at once.
 *
 * Invariant: after a reset everything handed out before is invalid, and what was reserved stays, so
 * that a row allocates from the heap only when it needs more than every row before it.
 */
#ifndef CS_BASE_ARENA_H
#define CS_BASE_ARENA_H

#include "base/context.h"

typedef struct cs_arena_chunk cs_arena_chunk;

typedef struct cs_arena {
  cs_arena_chunk *first, *current;
  size_t used; /* of the current chunk */
} cs_arena;

void cs_arena_init(cs_arena *arena);
void cs_arena_finish(cs_arena *arena, cs_memory *memory);
void cs_arena_reset(cs_arena *arena);
/* size bytes, aligned to 16; NULL, recorded in the context, without memory. */
void *cs_arena_take(celspan_context *context, cs_arena *arena, size_t size);

#endif
