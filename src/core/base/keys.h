/* Sorting numbers of things by a whole number of 32 bits: a few passes over all of them, however
 * many there are.
 *
 *     key   [ what is sorted by | the number of the thing ]     two halves of 32 bits
 *
 * Invariant: keys that are sorted by the same number keep their order.
 */
#pragma once

#include "base/context.h"

static inline uint64_t cs_key(int32_t by, size_t number) {
  return (uint64_t)((int64_t)by - INT32_MIN) << 32 | number;
}

static inline int32_t cs_key_by(uint64_t key) {
  return (int32_t)((int64_t)(key >> 32) + INT32_MIN);
}

static inline uint32_t cs_key_number(uint64_t key) { return (uint32_t)key; }

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_keys_sort(celspan_context *context, uint64_t *keys, size_t count);
