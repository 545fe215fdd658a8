/* The fold of over.h by tree, for frames of flat layers of which very many are seen at once, because
 * each of them takes only little of the light.
 *
 *                                  [all]                            level 3
 *                    ________________|________________
 *              [ 255-192 ]   [ 191-128 ]   [ 127-64 ]   [ 63-0 ]    level 2: a word each
 *                     ________________________|___
 *               [127-112]  [111-96]  [95-80]  [79-64]               level 1
 *                    ___________|____________
 *               [111-108] [107-104] [103-100] [99-96]               level 0: quads, looked up
 *
 * A node keeps the light of its layers, and what they let through, by themselves. When a layer comes
 * or goes its quad is looked up anew, and so are made the nodes above it: a few, however many layers
 * lie over each other. Four nodes are joined by two over two, so that nothing waits for long.
 *
 * Where the layers together let nothing through, those behind the end must not count, down to the
 * last bit: then the tree is gone down from the front, node by node, and the word in which the light
 * ends is added layer by layer.
 *
 * Invariant: the light of a set depends on the set alone, to the bit: what is joined with what is
 * given by the numbers of the layers, whatever was known before.
 */
#ifndef CS_COMPOSE_OVER_TREE_H
#define CS_COMPOSE_OVER_TREE_H

#include "compose/over_quads.h"

#define CS_OVER_TREE_WORDS 256 /* of a stack, at most: all are compared each time */
#define CS_OVER_TREE_LEVELS 8  /* enough for these */

typedef struct cs_over_tree {
  celspan_context *context;
  const cs_stack *stack;
  uint64_t *words;      /* the layers present */
  cs_over_pair **quads; /* one table a word; NULL: not yet */
  size_t word_count;
  cs_over_pair *nodes; /* of all levels */
  size_t node_count;
  cs_over_pair *levels[CS_OVER_TREE_LEVELS]; /* in nodes: 0 has the quads, the last has one node */
  int top;                                   /* the last level */
} cs_over_tree;

/* Whether this is the way for a stack that over_table.h suits. */
bool cs_over_tree_suits(const cs_stack *stack);
/* Errors: NO_MEMORY; cs_over_tree_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_over_tree_init(cs_over_tree *tree, celspan_context *context,
                                                 const cs_stack *stack);
void cs_over_tree_finish(cs_over_tree *tree);
/* The light of a set. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_tree_light(cs_over_tree *tree, const uint64_t *set,
                                                  cs_over_pair *out);

#endif
