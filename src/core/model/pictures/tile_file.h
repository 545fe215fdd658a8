/* The files of a picture in tiles: FOLDER/LEVEL/COLUMN_ROW.ENDING, where level 0 is one pixel.
 *
 * INVARIANT: a tile is a file of its own, no link to another folder.
 */
#pragma once

#include "model/pictures/module.h"
#include "model/pictures/picture.h"

#define CS_TILE_FILE_PATH 4096

/* A tile of a level; here level 0 is the finest. */
typedef struct cs_tile_file {
  int level;
  int32_t column, row;
} cs_tile_file;

/* Writes the path of a tile. false: it does not exist. */
bool cs_tile_file_find(const cs_picture *picture, cs_tile_file tile, char path[CS_TILE_FILE_PATH]);
/* Adds the folders of the levels, whose times change when a tile is added, removed or renamed. */
void cs_tile_file_hash(const cs_picture *picture, cs_hash *hash);
/* The header of the picture, and how many levels have tiles: the finest ones, up to the first that
 * has one of the first column and row. Errors: INPUT: there is none. */
CELSPAN_CHECKED celspan_status cs_tile_file_describe(celspan_context *context,
                                                     const cs_picture *picture,
                                                     cs_picture_header *out, int *levels);
