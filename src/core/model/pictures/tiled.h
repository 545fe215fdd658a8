/* Pictures in tiles: each level is made of the tiles that it has.
 *
 *   level 2  +---+           a level above all that have tiles is made from the level below
 *   level 1  +---+---+
 *   level 0  +-+-+ . .       where a tile is missing: the next level in twice its size (bilinear)
 *
 * INVARIANT: a block is a function of the files alone, whichever blocks were made before. A tile
 * has the size that its place says.
 */
#pragma once

#include "model/pictures/part.h"

/* Fills the texels of a block, which are clear, of one of the entry's `tiled_levels`, while
 * `reading` is locked. Errors: as cs_load_block. */
CELSPAN_CHECKED celspan_status cs_tiled_fill(const cs_part_reader *reader,
                                             const cs_picture_entry *entry,
                                             cs_picture_block *block);
