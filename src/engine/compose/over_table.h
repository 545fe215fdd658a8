/* The fold of over.h by table, for frames of flat layers in no group and with no back light between
 * them: no move is ever due, so layers can be folded beforehand.
 *
 *     set    [........ word 1 ........][........ word 0 ........]     64 layers a word
 *                                       0110 0000 ... 1011 0100       4 layers a quad
 *                                         |              |
 *                                    table of 16    table of 16       light of any choice of 4
 *                                         \_____ over ___/
 *                                              |
 *                         light of word 1 over light of word 0        kept; made again when the
 *                                                                     word of the set has changed
 *
 * Neighbouring cells differ in few layers, so only few words are folded again. Words are folded
 * from the front until nothing shines through.
 *
 * Invariant: the light of a set depends on the set alone, to the bit. The layers of a word are
 * folded in an order given by their numbers, whatever was known before; the word in which the light
 * ends is folded layer by layer, and the layers behind the end are left out.
 */
#pragma once

#include "engine/compose/over.h"

/* The layers of one word of a set. */
typedef struct cs_over_word {
  uint64_t word;       /* those present */
  cs_over_pair *quads; /* what any choice of each four layers gives, 16 times 16; NULL: not yet */
  cs_over_pair all;    /* of the whole word */
} cs_over_word;

typedef struct cs_over_table {
  celspan_context *context;
  const cs_stack *stack;
  cs_over_word *words;
  size_t count;
} cs_over_table;

/* Whether the layers of a stack are of that kind. */
bool cs_over_table_suits(const cs_stack *stack);
/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_table_init(cs_over_table *table, celspan_context *context,
                                                  const cs_stack *stack);
void cs_over_table_finish(cs_over_table *table);
/* The light of a set; filled: of its words, see set.h. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_table_light(cs_over_table *table, const uint64_t *set,
                                                   const uint8_t *filled, cs_over_pair *out);
