/* Counts and hashes of scene values. Only the count of references ever changes in a value. */
#pragma once

#include <string.h>

#include "base/counted.h"
#include "base/hash.h"
#include "model/colour/paint.h"

/* The first word of every structural hash, so that values of different kinds have different
 * hashes. */
typedef enum cs_value_kind {
  CS_VALUE_TEXTURE = 1,
  CS_VALUE_DATA,
  CS_VALUE_OBJECT,
  CS_VALUE_CEL,
  CS_VALUE_ROSTRUM,
  CS_VALUE_GRADE,
  CS_VALUE_SHIFT,
  CS_VALUE_NEARBY
} cs_value_kind;

/* Copies a value, whose first field is its reference count. The count is not copied, because other
 * threads may change it: the count of the copy is 1. The references inside the value are not
 * counted again. */
static inline void cs_value_copy(void *to, const void *from, size_t size) {
  atomic_init((atomic_size_t *)to, 1);
  const size_t count = sizeof(atomic_size_t);
  memcpy((char *)to + count, (const char *)from + count, size - count);
}

void cs_value_hash_point(cs_hash *hash, celspan_point point);
void cs_value_hash_box(cs_hash *hash, const celspan_box *box);
void cs_value_hash_matrix(cs_hash *hash, const celspan_matrix *matrix);
void cs_value_hash_paint(cs_hash *hash, const cs_paint *paint);
void cs_value_hash_light(cs_hash *hash, const celspan_light *light);
/* A hash as the two words that hosts are given. */
void cs_value_hash_give(cs_hash hash, uint64_t out[2]);
