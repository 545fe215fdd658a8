#include "model/pictures/tile_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>

#include "base/open.h"
#include "model/pictures/mip_levels.h"

static mode_t kind_of(const char *path) {
  struct stat found;
  bool is_there = fstatat(AT_FDCWD, path, &found, AT_SYMLINK_NOFOLLOW) == 0;
  return is_there ? found.st_mode & S_IFMT : 0;
}

bool cs_tile_file_find(const cs_picture *picture, cs_tile_file tile, char path[CS_TILE_FILE_PATH]) {
  const celspan_picture_tiles *tiles = &picture->tiles;
  int level = cs_mip_levels_count(tiles->width, tiles->height) - 1 - tile.level;
  return snprintf(path, CS_TILE_FILE_PATH, "%s/%d", picture->file, level) < CS_TILE_FILE_PATH &&
         kind_of(path) == S_IFDIR &&
         snprintf(path, CS_TILE_FILE_PATH, "%s/%d/%d_%d.%s", picture->file, level, (int)tile.column,
                  (int)tile.row, tiles->ending) < CS_TILE_FILE_PATH &&
         kind_of(path) == S_IFREG;
}

void cs_tile_file_hash(const cs_picture *picture, cs_hash *hash) {
  char path[CS_TILE_FILE_PATH];
  int count = cs_mip_levels_count(picture->tiles.width, picture->tiles.height);
  for (int level = 0; level < count; level++)
    if (snprintf(path, sizeof path, "%s/%d", picture->file, level) < CS_TILE_FILE_PATH)
      cs_open_hash(hash, path);
}

celspan_status cs_tile_file_describe(celspan_context *context, const cs_picture *picture,
                                     cs_picture_header *out, int *levels) {
  const celspan_picture_tiles *tiles = &picture->tiles;
  char path[CS_TILE_FILE_PATH];
  int count = cs_mip_levels_count(tiles->width, tiles->height);
  *out = (cs_picture_header){.info = {.struct_size = sizeof out->info,
                                      .width = tiles->width,
                                      .height = tiles->height,
                                      .channels = 4, /* where no level has a tile, it is clear */
                                      .has_alpha = true,
                                      .format = "dzi",
                                      .colour = "srgb"}};
  while (count > 0 && !cs_tile_file_find(picture, (cs_tile_file){count - 1, 0, 0}, path))
    count--;
  *levels = count;
  return count > 0 ? CELSPAN_OK
                   : cs_fail(context, CELSPAN_INPUT, "%s: no level has its first tile, 0_0.%s",
                             picture->file, tiles->ending);
}
