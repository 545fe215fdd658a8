/* Where the order of the active boundaries differs from the order at the height before.
 *
 *   before   a  b  c  d  e  f         low = 1: the first boundary is the same in both
 *   after    a  c  b  d  f            tail = 1: the last boundary is the same in both
 */
#ifndef CS_SWEEP_CHANGE_H
#define CS_SWEEP_CHANGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where the order at a height differs from the order before. The boundaries left of index `low` and
 * the last `tail` ones are the same as before, and so are the cells between them. */
typedef struct cs_change {
  size_t low, tail;
} cs_change;

static const cs_change cs_change_none = {SIZE_MAX, SIZE_MAX};
static const cs_change cs_change_all = {0, 0};

static inline bool cs_change_is_none(cs_change change) { return change.low == SIZE_MAX; }

static inline cs_change cs_change_join(cs_change a, cs_change b) {
  return (cs_change){a.low < b.low ? a.low : b.low, a.tail < b.tail ? a.tail : b.tail};
}

#endif
