/* The geometry of a pyramid of tiles: its levels, its tiles, and their names.
 *
 *   level L      +---+---+---+-+    the frame, cut into tiles; those at the right and at the
 *                |   |   |   | |    bottom can be smaller
 *                +---+---+---+-+
 *                +---+---+---+-+
 *   level L - 1  +---+---+          half of its width and height
 *                +---+---+
 *   ...
 *   level 0      .                  one pixel
 *
 *   Deep Zoom   NAME.dzi        NAME_files/LEVEL/COLUMN_ROW.png
 *   IIIF        NAME/info.json  NAME/X,Y,W,H/W,H/0/default.png   (Image API 3.0, level 0)
 *
 * INVARIANT  The top level is the frame itself and each level below is half as large, rounded up,
 * as in Deep Zoom: level i of a frame of top level L is ceil(size / 2^(L - i)), and level 0 is one
 * pixel. IIIF counts scale factors instead: level i has 2^(L - i).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "inside/context.h"

typedef enum cs_pyramid_layout { CS_PYRAMID_DZI = 0, CS_PYRAMID_IIIF } cs_pyramid_layout;

typedef struct cs_pyramid {
  cs_pyramid_layout layout;
  int32_t width, height; /* the width and height of the frame */
  int32_t tile, overlap; /* pixels; the overlap is added on sides that have a neighbour */
  const char *folder;    /* the folder of all files */
  const char *name;
  const char *ending; /* the ending of a tile: "png", "jpg" */
} cs_pyramid;

/* One tile. */
typedef struct cs_pyramid_tile {
  int32_t level, column, row;
} cs_pyramid_tile;

/* A half-open rectangle of the pixels of a level, or of its tiles. */
typedef struct cs_pyramid_box {
  int32_t x0, y0, x1, y1;
} cs_pyramid_box;

int32_t cs_pyramid_top(const cs_pyramid *pyramid);
/* The highest level with at most this many pixels a side. */
int32_t cs_pyramid_within(const cs_pyramid *pyramid, int32_t side);
/* The highest level that is a single tile. */
int32_t cs_pyramid_single(const cs_pyramid *pyramid);
void cs_pyramid_size(const cs_pyramid *pyramid, int32_t level, int32_t *width, int32_t *height);
/* The tiles of a level, or only the tiles that a region of the frame touches; region: NULL for
 * all. */
cs_pyramid_box cs_pyramid_tiles(const cs_pyramid *pyramid, int32_t level,
                                const cs_pyramid_box *region);
/* The pixels of a rectangle of tiles, including their overlap. */
cs_pyramid_box cs_pyramid_pixels(const cs_pyramid *pyramid, int32_t level,
                                 const cs_pyramid_box *tiles);

/* Writes the path of a tile, which begins with FOLDER. is_alias: the second name ("full") that IIIF
 * gives to the only tile of a level. false: the path is too long, or there is no such name. */
bool cs_pyramid_path(const cs_pyramid *pyramid, cs_pyramid_tile tile, bool is_alias, char *path,
                     size_t size);
/* Writes the path of the folder of the tiles, which is in FOLDER. false: the path is too long. */
bool cs_pyramid_tiles_folder(const cs_pyramid *pyramid, char *path, size_t size);
/* Sets and returns the failure of a path that is too long. */
celspan_status cs_pyramid_too_long(celspan_context *context, const cs_pyramid *pyramid);
