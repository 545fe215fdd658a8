/* Boolean trees over tiles: where the layers of a tree are certain to contribute, given where they are
 * certain to be present and where they may be. tree.h does the same for a point, where everything
 * is known.
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
#ifndef CS_COMPOSE_TREE_CERTAIN_H
#define CS_COMPOSE_TREE_CERTAIN_H

#include "compose/stack.h"
#include "sweep/cull.h"

typedef struct cs_tree_certain_result {
  cs_cull_presence presence;
  uint32_t end; /* of the layers below */
} cs_tree_certain_result;

/* painted: where each layer contributes. Both arrays begin with the tree's first layer. results:
 * room for step_depth entries. */
void cs_tree_certain(const cs_stack *stack, const cs_tree *tree, const cs_cull_presence *presences,
                     cs_tree_certain_result *results, uint64_t *painted);

#endif
