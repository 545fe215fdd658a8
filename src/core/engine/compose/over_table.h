/* The fold of over.h by table, for frames of many faint flat layers in no group and with no back
 * light between them: no move is ever due, so layers can be folded beforehand.
 *
 *     set      [........ word 1 ........][........ word 0 ........]     64 layers a word
 *     quarters                    [ 15-12 ][ 11-8 ][ 7-4 ][ 3-0 ]       16 layers a quarter
 *     quads                       [1011][0000][0110][0100]              4 layers a quad
 *                                            |
 *                                      table of 16: the light of any choice of 4 layers
 *
 * Each word keeps the light of its layers, and what they let through, by themselves. When one
 * comes or goes, its quarter is looked up and joined again, and then the word. Of four parts two
 * and two are joined first, so that a result waits for few others.
 *
 * Where layers are so faint that dozens of them are seen at once, most of a fold from the front
 * would be done again for each cell. So there is a tree over the words, four of each node, and only
 * the nodes above a change are joined again.
 *
 *                                [all]                          tier 2: what the tree ends with
 *                    ______________|______________
 *              [ 15-12 ]    [ 11-8 ]   [ 7-4 ]   [ 3-0 ]        tier 1: four words a node
 *                             ____________|___
 *                            [7]  [6]  [5]  [4]                 tier 0: words
 *
 * Where the layers together let nothing through, those behind the end must not count, down to the
 * last bit. Then the fold goes down from the front, part by part, to the quad in which the light
 * ends; its layers are added one by one.
 *
 * Invariant: the light of a set depends on the set alone, to the bit: what is joined is given by
 * the numbers of the layers, whatever was known before. Layers behind others that let clearly less
 * through than CS_PAINT_OPAQUE change no bit: for the cull leaves them out.
 */
#pragma once

#include "engine/compose/over.h"

#define CS_OVER_FOUR 4          /* parts that are joined: layers, quads, quarters, words, nodes */
#define CS_OVER_TABLE_WORDS 256 /* at most: all of them are compared each time */
#define CS_OVER_TABLE_TIERS 5   /* enough for this number of words */

/* The layers of one word of a set. */
typedef struct cs_over_word {
  uint64_t word;                       /* the layers present */
  cs_over_pair *quads;                 /* for every choice among four layers; NULL: not made yet */
  cs_over_pair quarters[CS_OVER_FOUR]; /* the quarters of sixteen layers each */
} cs_over_word;

typedef struct cs_over_table {
  celspan_context *context;
  const cs_stack *stack;
  CS_ARRAY(cs_over_word, words);
  CS_ARRAY(cs_over_pair, nodes); /* the nodes of all tiers */
  size_t count, node_count;
  cs_over_pair *tiers[CS_OVER_TABLE_TIERS]; /* in nodes: 0 has the words */
  int top;                                  /* the last tier, which has one node */
} cs_over_table;

/* Whether a table suits a stack of flat layers: the layers are many, and on the average so faint
 * that more than 32 of them would be seen in a place. */
bool cs_over_table_suits(const cs_stack *stack);
/* stack: one that a table suits. Errors: NO_MEMORY; cs_over_table_finish must be called then,
 * too. */
CELSPAN_CHECKED celspan_status cs_over_table_init(cs_over_table *table, celspan_context *context,
                                                  const cs_stack *stack);
void cs_over_table_finish(cs_over_table *table);
/* The light of a set. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_table_light(cs_over_table *table, const uint64_t *set,
                                                   cs_over_pair *out);
