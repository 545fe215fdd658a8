/* Meshes: a grid of points over the box of a shape, and where a map takes them.
 *
 *     +--+--+--+--+        before           Each cell becomes two triangles, on each of which the
 *     |r/|r/|r/|r/|                         map is replaced by the affine one between its corners:
 *     +--+--+--+--+        r: the rim       neighbours agree on their common side. A rim, as wide
 *     |r/| /| /|r/|                         as the curved sides of the box bulge, continues the
 *     +--+--+--+--+                         outermost cells, so that the triangles cover the whole
 *     |r/|r/|r/|r/|                         image of the box.
 *     +--+--+--+--+
 *
 * Invariants: points are in rows, (columns + 1) * (rows + 1) of them, the rim included. Where the
 * map is the identity, `to` equals `from` bitwise.
 */
#pragma once

#include "model/scene/scene.h"
#include "model/warp/map.h"

typedef struct cs_warp_mesh {
  size_t columns, rows; /* cells, including the rim */
  celspan_point *from, *to;
} cs_warp_mesh;

static inline size_t cs_warp_mesh_points(const cs_warp_mesh *mesh) {
  return (mesh->columns + 1) * (mesh->rows + 1);
}

/* Makes a mesh of as few cells as possible, so that its error is at most the share CS_WARP_PLAIN of
 * the object, with at most map->pieces triangles. finish frees it, also after an error. Errors:
 * NO_MEMORY; those of the map. */
#define CS_WARP_PLAIN (1 / 2048.0)
CELSPAN_CHECKED celspan_status cs_warp_mesh_make(const cs_warp_map *map, const celspan_box *box,
                                                 cs_warp_mesh *out);
void cs_warp_mesh_finish(cs_warp_mesh *mesh, cs_memory *memory);

/* BAD_ARGUMENT if the map folds: if a triangle has the opposite orientation of most others, at a
 * place that the shape covers. data, matrix: the shape, and its place. */
CELSPAN_CHECKED celspan_status cs_warp_mesh_check(const cs_warp_map *map, const cs_warp_mesh *mesh,
                                                  const cs_primitive_data *data,
                                                  const celspan_matrix *matrix);
