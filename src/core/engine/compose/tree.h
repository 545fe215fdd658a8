/* Boolean trees on sets of layers.
 *
 * Every operator yields the present operands one over the other, or nothing, so a tree only decides
 * which layers contribute. The layers of a tree are a range of neighbouring bits, so operators over
 * layers alone are answered a word at a time, however many there are.
 *
 *     difference( union(0, 1, 2), intersection(3, 4) )          steps, in post-order:
 *
 *                difference                                       union         [0, 3)
 *               /          \                                      intersection  [3, 5)
 *           union        intersection                             difference    [0, 5)
 *          /  |  \         /      \
 *     set  1  0  1        1        0        union: present; intersection: 4 is missing
 *     after                                 difference: only its first operand is present
 *          1  0  1        0        0        bits 3 and 4 are cleared, 0 and 2 contribute
 *
 * Few operands of a large tree are present at a place: a guard before the steps of an operator
 * names layers that it needs one of (of a clip, those of its shape; of a difference, of its first
 * operand), so that the steps of what is absent are skipped.
 *
 * A rostrum that is an object has a layer for its frame, behind all its others: where that one is
 * absent, all are cleared; where it is present, the object is, whatever is painted there.
 */
#pragma once

#include "engine/compose/stack.h"
#include "engine/sweep/cull.h"

typedef struct cs_tree_result {
  uint32_t first, end; /* the range of its layers */
  bool is_present;
} cs_tree_result;

/* Turns presence into contribution in place: clears the bits of layers that their boolean trees
 * hide. results: room for step_depth entries. */
void cs_tree_resolve(const cs_stack *stack, uint64_t *set, cs_tree_result *results);

/* Boolean trees over tiles: where the layers of a tree are certain to contribute, given where they
 * are certain to be present and where they may be. tree.h does the same for a point, where
 * everything is known.
 *
 *     tiles            0    1    2    3    4        bits of a word, tile 0 first
 *     A  certain       0    1    1    1    0
 *        possible      1    1    1    1    0
 *     B  certain       0    0    0    1    1        boundaries of A are in tile 0, of B in tile 2
 *        possible      0    0    1    1    1
 *     A - B            ?    1    ?    0    0        certain: A, and B not even possible
 *     A & B            0    0    ?    1    0        certain: both
 *
 * Invariant: where a layer is said to contribute, it does so at every point of the tile.
 */

typedef struct cs_tree_certain_result {
  cs_cull_presence presence;
  uint32_t end; /* where the layers below the operator end */
} cs_tree_certain_result;

/* painted: where each layer contributes. Both arrays begin with the tree's first layer. results:
 * room for step_depth entries. */
void cs_tree_certain(const cs_stack *stack, const cs_tree *tree, const cs_cull_presence *presences,
                     cs_tree_certain_result *results, uint64_t *painted);
