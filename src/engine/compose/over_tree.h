/* The fold of over.h by tree, for frames of flat layers so faint that dozens of them are seen at
 * once.
 *
 *                                  [all]                            tier 3
 *                    ________________|________________
 *              [ 255-192 ]   [ 191-128 ]   [ 127-64 ]   [ 63-0 ]    tier 2: a word each
 *                     ________________________|___
 *               [127-112]  [111-96]  [95-80]  [79-64]               tier 1
 *                    ___________|____________
 *               [111-108] [107-104] [103-100] [99-96]               tier 0: quads, looked up
 *
 * A node keeps the light of its layers, and what they let through, by themselves. When a layer
 * comes or goes, its quad is looked up again and the nodes above it are joined again: one a tier,
 * however many layers lie over each other. Of four nodes two and two are joined first, so that a
 * result waits for few others.
 *
 * Where the layers together let nothing through, those behind the end must not count, down to the
 * last bit. Then the fold goes down the tree from the front, node by node, to the quad in which the
 * light ends; its layers are added one by one.
 *
 * Invariant: the light of a set depends on the set alone, to the bit: which nodes are joined is
 * given by the numbers of the layers, whatever was known before. Layers behind others that let
 * clearly less through than CS_PAINT_OPAQUE change no bit: for the cull leaves them out.
 */
#pragma once

#include "engine/compose/over.h"

#define CS_OVER_TREE_WORDS 256 /* of a set, at most: all are compared each time */
#define CS_OVER_TREE_TIERS 8   /* enough for these */

typedef struct cs_over_tree {
  celspan_context *context;
  const cs_stack *stack;
  uint64_t *words;      /* the layers present */
  cs_over_pair **quads; /* one table a word; NULL: not yet */
  size_t word_count;
  cs_over_pair *nodes; /* of all tiers */
  size_t node_count;
  cs_over_pair *tiers[CS_OVER_TREE_TIERS]; /* in nodes: 0 has the quads, the last has one node */
  int top;                                 /* the last tier */
} cs_over_tree;

/* Whether a stack that over_table.h suits is better folded by tree: its layers are many, and on the
 * average so faint that more than 32 in a place would be seen. */
bool cs_over_tree_suits(const cs_stack *stack);
/* Errors: NO_MEMORY; cs_over_tree_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_over_tree_init(cs_over_tree *tree, celspan_context *context,
                                                 const cs_stack *stack);
void cs_over_tree_finish(cs_over_tree *tree);
/* The light of a set. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_over_tree_light(cs_over_tree *tree, const uint64_t *set,
                                                  cs_over_pair *out);
