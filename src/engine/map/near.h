/* Which of the borders of a swath come near some columns.
 *
 *     columns     0 .. 31   32 .. 63   64 .. 95
 *     live 0         1          0          0        a bit for each border and tile of columns
 *     live 1         0          1          1
 *     live 2         1          1          0
 *
 * A swath at 1k has a thousand borders, and a pixel that is solved (exact.h) has two or three.
 *
 * Invariant: a border whose places from `low` to `high` are in a tile has its bit there; the rest
 * of a word is 0.
 */
#pragma once

#include "engine/map/swath.h"

#define CS_MAP_TILE 32 /* columns */

/* Finds the bits of the rows' swath, unless they are known. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_near_find(celspan_context *context, cs_map_rows *rows);

/* A bit for each of the 64 borders from 64 * word on: whether it is near the columns [first,
 * last]. */
static inline uint64_t cs_map_near_word(const cs_map_rows *rows, size_t word, int32_t first,
                                        int32_t last) {
  uint64_t bits = 0;
  for (int32_t tile = first / CS_MAP_TILE; tile <= last / CS_MAP_TILE; tile++)
    bits |= rows->near[(size_t)tile * rows->near_words + word];
  return bits;
}
