#include "model/pictures/tiled.h"

#include "model/pictures/tile_file.h"

enum { HALF = CS_PICTURE_BLOCK / 2 + 2 };

/* The pixels of a tile along an axis, with what it shares: from `begin`, `count` of them. */
typedef struct extent {
  int32_t begin, count;
} extent;

static extent extent_of(const celspan_picture_tiles *tiles, int32_t place, int32_t whole) {
  int64_t begin = (int64_t)place * tiles->size - (place > 0 ? tiles->overlap : 0);
  int64_t end = ((int64_t)place + 1) * tiles->size + tiles->overlap;
  return (extent){(int32_t)begin, (int32_t)((end < whole ? end : whole) - begin)};
}

static celspan_status copy_checked(const cs_part_reader *reader, const cs_picture *picture,
                                   cs_tile_file t, const cs_picture *piece, celspan_rectangle area,
                                   float *out) {
  const celspan_picture_tiles *tiles = &picture->tiles;
  extent x = extent_of(tiles, t.column, cs_mip_levels_size(tiles->width, t.level));
  extent y = extent_of(tiles, t.row, cs_mip_levels_size(tiles->height, t.level));
  celspan_picture_info info;
  CS_TRY(cs_store_info(reader->context, piece, &info));
  if (info.width != x.count || info.height != y.count)
    return cs_fail(reader->context, CELSPAN_INPUT,
                   "%s: it has %d x %d pixels; as this tile it must have %d x %d", piece->file,
                   (int)info.width, (int)info.height, (int)x.count, (int)y.count);
  area.x -= x.begin;
  area.y -= y.begin;
  return cs_part_copy(reader, piece, 0, &area, out, CS_PICTURE_BLOCK);
}

static celspan_status copy_tile(const cs_part_reader *reader, const cs_picture *picture,
                                cs_tile_file t, const char *path, celspan_rectangle area,
                                float *out) {
  const celspan_picture_desc desc = {
      .struct_size = sizeof desc, .file = path, .colour = picture->colour};
  cs_picture *piece;
  CS_TRY(cs_picture_create(reader->context, &desc, &piece));
  piece->is_tile = true;
  celspan_status status = copy_checked(reader, picture, t, piece, area, out);
  cs_picture_unref(piece);
  return status;
}

static int32_t clamp(int32_t i, int32_t size) { return i < 0 ? 0 : i < size ? i : size - 1; }

static void mix(const float *near, const float *far, float out[4]) {
  for (int c = 0; c < 4; c++)
    out[c] = near[c] + 0.25f * (far[c] - near[c]);
}

/* An area of a level from the next one: its texel i lies a quarter from the centre of i / 2.
 * texels: room for those of the next level, not on the stack: every missing level is another call
 * inside this one. */
static celspan_status enlarge_with(const cs_part_reader *reader, const cs_picture *picture,
                                   int level, celspan_rectangle area, float texels[][HALF][4],
                                   float *out) {
  const int32_t width = cs_mip_levels_size(picture->tiles.width, level);
  const int32_t height = cs_mip_levels_size(picture->tiles.height, level);
  int32_t left = clamp((area.x - 1) >> 1, width), top = clamp((area.y - 1) >> 1, height);
  const celspan_rectangle from = {left, top, clamp((area.x + area.width) / 2, width) - left + 1,
                                  clamp((area.y + area.height) / 2, height) - top + 1};
  float near[4], far[4];
  CS_TRY(cs_part_copy(reader, picture, level, &from, texels[0][0], HALF));
  for (int32_t y = area.y; y < area.y + area.height; y++, out += 4 * (size_t)CS_PICTURE_BLOCK)
    for (int32_t x = area.x; x < area.x + area.width; x++) {
      int32_t a = x / 2 - left, b = clamp(x / 2 + (x % 2 ? 1 : -1), width) - left;
      int32_t row = y / 2 - top, other = clamp(y / 2 + (y % 2 ? 1 : -1), height) - top;
      mix(texels[row][a], texels[row][b], near);
      mix(texels[other][a], texels[other][b], far);
      mix(near, far, out + 4 * (size_t)(x - area.x));
    }
  return CELSPAN_OK;
}

static celspan_status enlarge(const cs_part_reader *reader, const cs_picture *picture, int level,
                              celspan_rectangle area, float *out) {
  cs_memory *memory = reader->context->memory;
  float(*texels)[HALF][4] = cs_mem_array(memory, HALF, sizeof *texels);
  if (!texels)
    return cs_fail_memory(reader->context);
  celspan_status status = enlarge_with(reader, picture, level, area, texels, out);
  cs_mem_free(memory, texels, HALF * sizeof *texels);
  return status;
}

/* The texels of a block along an axis, and those of them that a tile gives. */
static extent within(int32_t block, int32_t whole) {
  int32_t begin = block * CS_PICTURE_BLOCK, left = whole - begin;
  return (extent){begin, left < CS_PICTURE_BLOCK ? left : CS_PICTURE_BLOCK};
}

static extent common(extent block, int32_t place, int32_t side) {
  int64_t begin = (int64_t)place * side, end = begin + side, last = block.begin + block.count;
  begin = begin > block.begin ? begin : block.begin;
  return (extent){(int32_t)begin, (int32_t)((end < last ? end : last) - begin)};
}

static celspan_status fill(const cs_part_reader *reader, const cs_picture_entry *entry,
                           cs_tile_file t, celspan_rectangle area, float *out) {
  char path[CS_TILE_FILE_PATH];
  if (cs_tile_file_find(entry->part, t, path))
    return copy_tile(reader, entry->part, t, path, area, out);
  return t.level + 1 < entry->tiled_levels ? enlarge(reader, entry->part, t.level + 1, area, out)
                                           : CELSPAN_OK;
}

celspan_status cs_tiled_fill(const cs_part_reader *reader, const cs_picture_entry *entry,
                             cs_picture_block *block) {
  const celspan_picture_tiles *tiles = &entry->part->tiles;
  const int32_t side = tiles->size;
  const extent x = within(block->column, cs_mip_levels_size(tiles->width, block->level));
  const extent y = within(block->row, cs_mip_levels_size(tiles->height, block->level));
  cs_tile_file t = {.level = block->level};
  for (t.row = y.begin / side; t.row <= (y.begin + y.count - 1) / side; t.row++)
    for (t.column = x.begin / side; t.column <= (x.begin + x.count - 1) / side; t.column++) {
      const extent columns = common(x, t.column, side), rows = common(y, t.row, side);
      CS_TRY(fill(reader, entry, t,
                  (celspan_rectangle){columns.begin, rows.begin, columns.count, rows.count},
                  block->texels + 4 * (size_t)((rows.begin - y.begin) * CS_PICTURE_BLOCK +
                                               columns.begin - x.begin)));
    }
  return CELSPAN_OK;
}
