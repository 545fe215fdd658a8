/* A table from hashes of 128 bits to numbers. Things with equal hashes count as the same thing.
 *
 * INVARIANT: at most half of the slots are used, so that a search always meets a free one.
 */
#pragma once

#include "base/context.h"
#include "base/hash.h"

typedef struct cs_hash_slot {
  cs_hash key;
  size_t number; /* the number plus 1; 0: the slot is free */
} cs_hash_slot;

/* All zero is an empty table. */
typedef struct cs_hash_table {
  cs_hash_slot *slots; /* 0 or 2^n of them */
  size_t slot_count, count;
} cs_hash_table;

/* The number of a key; false when the key is not in the table. */
bool cs_hash_table_find(const cs_hash_table *table, cs_hash key, size_t *number);
/* Adds a key, or gives it another number. Errors: NO_MEMORY; the table is unchanged then. */
CELSPAN_CHECKED celspan_status cs_hash_table_add(cs_hash_table *table, celspan_context *context,
                                                 cs_hash key, size_t number);
void cs_hash_table_finish(cs_hash_table *table, celspan_context *context);
