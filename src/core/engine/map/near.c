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
#include "engine/map/exact.h"

/* The tile of a place, of `count`. */
static int32_t tile_at(int32_t place, int32_t count) {
  int32_t tile = place / (CS_MAP_TILE * CS_MAP_UNIT);
  return place < 0 ? 0 : tile < count ? tile : count - 1;
}

celspan_status cs_map_near_find(celspan_context *context, cs_map_rows *rows) {
  if (rows->has_near)
    return CELSPAN_OK;
  const int32_t tiles = (rows->width - 1) / CS_MAP_TILE + 1;
  rows->near_words = (rows->live_count + 63) / 64;
  const size_t needed = (size_t)tiles * rows->near_words;
  CS_TRY(CS_ARRAY_RESERVE(context, rows->near, needed));
  if (needed > 0)
    memset(rows->near, 0, needed * sizeof *rows->near);
  for (size_t i = 0; i < rows->live_count; i++) {
    const cs_map_live *live = &rows->lives[i];
    int32_t last = tile_at(live->high, tiles);
    for (int32_t tile = tile_at(live->low, tiles); tile <= last; tile++)
      rows->near[(size_t)tile * rows->near_words + i / 64] |= UINT64_C(1) << i % 64;
  }
  rows->has_near = true;
  return CELSPAN_OK;
}
