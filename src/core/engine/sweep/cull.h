/* The cull: which boundaries can be left out because nothing of them can be seen.
 *
 * The frame is divided into rows of tiles, 64 tiles a row, so that a row of tiles is one machine
 * word. The tiles are filled layer by layer from the camera backwards. Where the layers that cover
 * a whole tile let (almost) nothing through, the tile is dead for every layer behind them. Layers
 * of a group are dead behind what the group has itself; a layer of a boolean tree fills a tile only
 * where it is certain to be painted.
 *
 *     tile     0   1   2   3   4   5   6   7
 *            +---+---+---+---+---+---+---+---+     d: dead for the layer that is being culled
 *            |  /|   |   | d | d\| d | d | d |
 *            | A |   |   | d | d |B d| d | d |     chain A touches a live tile: it is kept
 *            |/  |   |   | d | d | \ | d | d |     chain B touches dead tiles alone: it is culled
 *            +---+---+---+---+---+---+---+---+
 *                            ^
 *                            the deferred winding change of B: at the left edge of its first tile,
 *                            where it cannot be seen
 *
 * In a row of tiles a chain is kept if it touches a tile that is live for its layer, or if it
 * begins or ends in the row; otherwise a deferred winding change takes its place.
 *
 * Invariants
 *   - no composed colour changes: in a dead tile composing stops before it comes to the layer, so
 *     it does not matter where in the tile the layer's presence changes; and a cell that begins in
 *     a dead tile is opaque over its whole width;
 *   - which chains are kept depends on the frame and on the row of tiles alone.
 */
#pragma once

#include "base/arrays.h"
#include "model/geometry/boundary.h"

#define CS_CULL_COLUMNS 64 /* tiles in a row of tiles */

#define CS_CULL_NONE UINT32_MAX /* no group */

/* A layer as the cull needs to know it. */
typedef struct cs_cull_layer {
  /* The most that any channel lets through wherever the layer is painted; 1 where unknown. */
  double through;
  /* the layer is present where the bitwise and of the winding and this is not 0 */
  int32_t winding_mask;
  uint32_t group;   /* the innermost, or CS_CULL_NONE */
  bool is_anywhere; /* the layer may be present even where no chain makes it present */
} cs_cull_layer;

/* Layers that are composited by themselves, then mixed with clear: inside the group occlusion is
 * complete; the group hides the layers behind it by the factor `fade`. */
typedef struct cs_cull_group {
  uint32_t parent; /* or CS_CULL_NONE */
  uint32_t first;  /* the rearmost layer of the group */
  double fade;
} cs_cull_group;

/* Layers that are present but may be left unpainted, depending on the presence of other layers. */
typedef struct cs_cull_tree {
  uint32_t first, end;
} cs_cull_tree;

/* Tiles of a row, one bit for each: tiles that are wholly inside the layer, and tiles of which a
 * part may be inside. */
typedef struct cs_cull_presence {
  uint64_t certain, possible;
} cs_cull_presence;

/* Finds in which tiles the layers of a tree are certainly painted all over, given where they are
 * present; both arrays begin with the tree's first layer. scratch: of scratch_size bytes. */
typedef void (*cs_cull_resolve)(const void *user, size_t tree, const cs_cull_presence *presences,
                                void *scratch, uint64_t *painted);

/* A deferred winding change: it takes the place of a culled chain in one row of tiles. */
typedef struct cs_deferred {
  double x;
  uint32_t layer;
  int32_t direction;
} cs_deferred;

typedef struct cs_cull {
  int32_t tile_rows;                    /* 0: nothing is culled, and no other field is set */
  int32_t tile_height;                  /* pixels */
  CS_ARRAY(cs_deferred, deferred_list); /* by row of tiles, then by x */
  CS_ARRAY(uint32_t, deferred_starts);  /* tile_rows + 1 */
  /* by row of tiles: chains kept there that were not in the row above it */
  CS_ARRAY(uint32_t, enters);
  CS_ARRAY(uint32_t, enter_starts);
  CS_ARRAY(bool, kept);          /* for every row of tiles of every chain */
  CS_ARRAY(size_t, places);      /* by chain: the place in `kept` of its first row of tiles */
  CS_ARRAY(int32_t, first_rows); /* by chain: the number of its first row of tiles */
  size_t deferred_count, enter_count, kept_count, chain_count;
} cs_cull;

typedef struct cs_cull_desc {
  const cs_boundary_set *set;  /* in its final order */
  const cs_cull_layer *layers; /* from the rear to the camera */
  size_t layer_count;
  const cs_cull_group *groups; /* each a range of neighbouring layers */
  size_t group_count;
  const cs_cull_tree *trees; /* disjoint, rear first */
  size_t tree_count;
  cs_cull_resolve resolve; /* resolves a tree; called with `user` */
  const void *user;
  size_t scratch_size;
  int32_t width, height, margin; /* pixels */
  double opaque;                 /* a transmission of at most this counts as 0 */
  int workers;                   /* threads at most */
} cs_cull_desc;

/* Culls for heights from -margin to height + margin; the outermost tiles extend into the margin.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cull_create(celspan_context *context, const cs_cull_desc *desc,
                                              cs_cull *out);
void cs_cull_free(cs_cull *cull, cs_memory *memory);

/* The row of tiles in which a height lies; the first or last for heights beyond the frame. */
static inline int32_t cs_cull_row(const cs_cull *cull, double y) {
  double row = y / cull->tile_height;
  return row <= 0 ? 0 : row >= cull->tile_rows ? cull->tile_rows - 1 : (int32_t)row;
}

/* Whether a chain that crosses the row of tiles is kept in it. */
static inline bool cs_cull_keeps(const cs_cull *cull, uint32_t chain, int32_t row) {
  if (cull->tile_rows == 0)
    return true;
  return cull->kept[cull->places[chain] + (size_t)(row - cull->first_rows[chain])];
}
