/* Folds: the light of sets of plain leaves, flat and one over the other with nothing between.
 *
 * Neighbouring cells differ in few leaves, so what every word of a set gives by itself is kept, and
 * only words that changed are folded anew: from what any of four neighbouring leaves give, which is
 * looked up. Words are then folded from the front, until nothing shines through.
 *
 * Invariant: the light of a set depends on the set alone, to the bit: the leaves of a word fold
 * along the bits of their numbers, whatever was known before; the word in which the light ends
 * folds leaf by leaf, and what lies behind the end does not count.
 */
#ifndef CS_COMPOSE_OVER_TABLE_H
#define CS_COMPOSE_OVER_TABLE_H

#include "base/context.h"
#include "compose/stack.h"

/* Light gathered from some leaves by themselves, and what they let through. */
typedef struct cs_over_pair {
  cs_v4 e, t;
} cs_over_pair;

static const cs_over_pair cs_over_pair_clear = {{0, 0, 0, 0}, {1, 1, 1, 1}};

/* One glimpse over another: exactly the other where one of them is clear. */
static inline cs_over_pair cs_over_pair_over(cs_over_pair front, cs_over_pair back) {
  return (cs_over_pair){front.e + front.t * back.e, front.t * back.t};
}

/* The leaves of one word of a set. */
typedef struct cs_over_word {
  uint64_t word;       /* those present */
  cs_over_pair *parts; /* what any of each four leaves give, 16 times 16; NULL: not asked for yet */
  cs_over_pair all;    /* of the whole word */
} cs_over_word;

typedef struct cs_over_table {
  celspan_context *context;
  const cs_stack *stack;
  cs_over_word *words;
  size_t count;
} cs_over_table;

/* Whether the leaves of a stack are plain. */
bool cs_over_table_suits(const cs_stack *stack);
/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_table_init(cs_over_table *folds, celspan_context *context,
                                                  const cs_stack *stack);
void cs_over_table_finish(cs_over_table *folds);
/* The light of a set. filled: for every word of it, and on to a multiple of eight, 0 where it is 0.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_table_light(cs_over_table *folds, const uint64_t *set,
                                                   const uint8_t *filled, cs_over_pair *out);

/* The end of the first eight words at or below `end` that are not all empty; end: a multiple of
 * eight. */
static inline uint32_t cs_over_table_skip(const uint8_t *filled, uint32_t end) {
  uint64_t eight = 0;
  for (; end > 0; end -= 8) {
    memcpy(&eight, filled + end - 8, sizeof eight);
    if (eight != 0)
      break;
  }
  return end;
}

#endif
