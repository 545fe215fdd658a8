/* The cull: which boundaries can be left out because nothing shines through to them.
 *
 * The frame is laid out in rows of tiles, 64 columns each, a machine word a row. The tiles are
 * filled leaf by leaf from the camera backwards; where the leaves that cover a whole tile let
 * (almost) nothing through, the tile is dead for all leaves behind. In a row of tiles
 *
 *   a chain is kept if it touches a tile that is live for its leaf, or begins or ends there;
 *   else it becomes a toggle: its crossing happens at the left edge of its first tile, unseen.
 *
 * Invariants: no composed colour changes by it: in a dead tile composing stops before the leaf is
 * reached, so where in such a tile its presence changes does not show; a cell that begins in a dead
 * tile is opaque as far as it goes. What is kept depends on the frame and the row alone.
 */
#ifndef CS_SWEEP_CULL_H
#define CS_SWEEP_CULL_H

#include "geometry/boundary.h"

#define CS_CULL_COLUMNS 64

/* A leaf as the cull sees it, in order from the rear to the camera. */
typedef struct cs_cull_layer {
  double
      through; /* the most that any channel lets through wherever the leaf is present; 1: unknown */
  int32_t winding_mask;
} cs_cull_layer;

/* A crossing that takes the place of a culled chain in one row of tiles. */
typedef struct cs_deferred {
  double x;
  uint32_t layer;
  int32_t direction;
} cs_deferred;

typedef struct cs_cull {
  int32_t tile_rows;          /* 0: nothing is culled */
  int32_t tile_height;        /* pixels */
  cs_deferred *deferred_list; /* by row of tiles, then by x */
  uint32_t *deferred_starts;  /* tile_rows + 1 */
  uint32_t *enters; /* by row of tiles: chains kept there that were not in the row above it */
  uint32_t *enter_starts;
  bool *kept;          /* for every row of tiles of every chain */
  size_t *places;      /* by chain: of its first row of tiles in `kept` */
  int32_t *first_rows; /* by chain: which row of tiles that is */
  size_t deferred_count, enter_count, kept_count, chain_count;
} cs_cull;

/* Culls a set in its final order, for heights from -margin to height + margin; the outermost tiles
 * reach into the margin. opaque: what counts as nothing shining through. workers: threads at most.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cull_create(celspan_context *context, const cs_boundary_set *set,
                                              const cs_cull_layer *layers, size_t layer_count,
                                              int32_t width, int32_t height, int32_t margin,
                                              double opaque, int workers, cs_cull *out);
void cs_cull_free(cs_cull *cull, cs_memory *memory);

/* The row of tiles that holds a height; the first or last for heights beyond the frame. */
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

#endif
