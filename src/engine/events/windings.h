/* Windings: how often the outline of each layer winds around a place. A drawing has as many
 * different ones as it has faces, at most, and each has a number.
 *
 *        0  |  1 = 0 and A  |  2 = 1 and B    |  1        crossing a boundary from left to right
 *           a               b                 c           leads from one to another
 *
 *     0 ---a--- 1 ---b--- 2        each but the first remembers how it was found: they form a
 *                                  tree, along which all can be visited with few steps
 *
 * Windings are told apart by a hash that is a sum over the layers, so that the way to them does not
 * matter. Two sums of 64 bits make it unlikely beyond practice that different ones share one.
 */
#pragma once

#include "base/context.h"

typedef struct cs_windings_hash {
  uint64_t a, b;
} cs_windings_hash;

typedef struct cs_windings_entry {
  cs_windings_hash hash;
  uint32_t parent, boundary; /* the winding that this one comes from, and the boundary crossed; 0
                                has none */
  int32_t zone;              /* for the caller: the zone in which they were met last; 0: none */
} cs_windings_entry;

typedef struct cs_windings {
  cs_windings_entry *entries; /* 0: nothing winds around the place */
  uint32_t *slots;            /* numbers plus 1; 0: free. A power of two */
  size_t count, capacity, slot_count;
} cs_windings;

/* Errors: NO_MEMORY; cs_windings_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_windings_init(celspan_context *context, cs_windings *windings);
void cs_windings_finish(cs_windings *windings, cs_memory *memory);
/* A hash, changed by crossing a boundary of a layer. */
cs_windings_hash cs_windings_add(cs_windings_hash hash, uint32_t layer, int32_t direction);
/* The number of the windings right of a boundary that changes the hash by `change`. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_windings_cross(celspan_context *context, cs_windings *windings,
                                                 uint32_t from, uint32_t boundary,
                                                 cs_windings_hash change, uint32_t *out);
