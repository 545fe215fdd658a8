/* Sorting in place, without memory of its own: a few items by insertion, many by a heap, so that n
 * items never cost more than n log n.
 *
 *     static inline bool is_before(const thing *a, const thing *b) ...
 *     CS_SORT_DEFINE(sort_things, thing, is_before)     defines sort_things(thing *, size_t)
 *
 * Invariant: where is_before is a strict order of all items, the result does not depend on the
 * order that they had.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* How two numbers are ordered, as qsort asks for it: below 0, 0, or above 0. */
#define CS_SORT_ORDER(a, b) (((a) > (b)) - ((a) < (b)))

#define CS_SORT_FEW 24 /* items that are sorted by insertion, at most */

/* In the heap, most roots came from the bottom and return there. So the way down to a leaf is made
 * without comparing, and the root moves up from the leaf. */
#define CS_SORT_DEFINE(name, type, is_before)                                                      \
  static inline void name##_insert(type *items, size_t count) {                                    \
    for (size_t i = 1; i < count; i++) {                                                           \
      if (!is_before(&items[i], &items[i - 1]))                                                    \
        continue;                                                                                  \
      type moved = items[i];                                                                       \
      size_t hole = i;                                                                             \
      for (; hole > 0 && is_before(&moved, &items[hole - 1]); hole--)                              \
        items[hole] = items[hole - 1];                                                             \
      items[hole] = moved;                                                                         \
    }                                                                                              \
  }                                                                                                \
  static inline void name##_sift(type *items, size_t root, size_t count) {                         \
    type moved = items[root];                                                                      \
    size_t hole = root;                                                                            \
    for (size_t child; (child = 2 * hole + 1) < count; hole = child) {                             \
      child += child + 1 < count && is_before(&items[child], &items[child + 1]);                   \
      items[hole] = items[child];                                                                  \
    }                                                                                              \
    for (size_t parent; hole > root && is_before(&items[parent = (hole - 1) / 2], &moved);         \
         hole = parent)                                                                            \
      items[hole] = items[parent];                                                                 \
    items[hole] = moved;                                                                           \
  }                                                                                                \
  static inline void name(type *items, size_t count) {                                             \
    if (count <= CS_SORT_FEW) {                                                                    \
      name##_insert(items, count);                                                                 \
      return;                                                                                      \
    }                                                                                              \
    for (size_t i = count / 2; i-- > 0;)                                                           \
      name##_sift(items, i, count);                                                                \
    for (size_t i = count; i-- > 1;) {                                                             \
      type largest = items[0];                                                                     \
      items[0] = items[i];                                                                         \
      items[i] = largest;                                                                          \
      name##_sift(items, 0, i);                                                                    \
    }                                                                                              \
  }
