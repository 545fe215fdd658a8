/* The borders of the label picture as one planar graph: chains of the sides of pixels, from node to
 * node or closed.
 *
 *      corner (x, y)                        directions and the pixels beside them, along x, y
 *      |     node: three or more                         3
 *      v     borders meet                  (x-1,y-1) | (x,y-1)
 *      +--+--N--+--+                             2 --+-- 0
 *      |  a  |  b  |                       (x-1,y)   | (x,y)
 *      +  +--N--+  N                                 1
 *      |  |  c  |  |        left of direction 0 is (x, y-1), right of it (x, y)
 *      +--N--+--N--+
 *
 * INVARIANT: every side between pixels of different labels, the picture's rim included, is in
 * exactly one chain, and a chain has one region on its left and one on its right, all along. A
 * closed chain has no node. Around every region lead its chains, each once.
 */
#pragma once

#include "inside/context.h"
#include "tools/trace/regions.h"

#define CS_NODE_NONE UINT32_MAX
#define CS_WAY_NONE UINT32_MAX

/* A chain in one of its two directions: twice its index, plus 1 for the reverse direction. */
typedef uint32_t cs_way;

typedef struct cs_node {
  int32_t x, y;
  cs_way out[4]; /* by direction; CS_WAY_NONE: no border leaves in this direction */
} cs_node;

typedef struct cs_chain {
  int32_t x, y; /* where the chain begins */
  size_t first; /* where the directions of the border begin */
  uint32_t count;
  uint32_t left, right; /* regions */
  uint32_t from, to;    /* the nodes; CS_NODE_NONE: the chain is closed */
} cs_chain;

typedef struct cs_borders {
  CS_ARRAY(cs_node, nodes); /* by y, then x */
  CS_ARRAY(cs_chain, chains);
  CS_ARRAY(unsigned char, directions);
  size_t node_count, chain_count, direction_count;
} cs_borders;

/* Whether a chain is part of the rim of the picture. */
static inline bool cs_chain_is_rim(const cs_chain *chain) {
  return chain->left == CS_REGION_OUTSIDE || chain->right == CS_REGION_OUTSIDE;
}

/* The step of a direction along x and y. */
static inline int32_t cs_border_x(int direction) {
  return direction == 0 ? 1 : direction == 2 ? -1 : 0;
}
static inline int32_t cs_border_y(int direction) {
  return direction == 1 ? 1 : direction == 3 ? -1 : 0;
}

/* Errors: NO_MEMORY. The result must be finished, also after a failure. */
CELSPAN_CHECKED celspan_status cs_borders_make(celspan_context *context,
                                               const cs_material *material,
                                               const cs_regions *regions, cs_borders *out);
void cs_borders_finish(cs_borders *borders, celspan_context *context);
