#include "writers/tiles/pyramid.h"

#include <inttypes.h>
#include <stdio.h>

/* ---------------------------------------------------------------- levels */

static int32_t halved(int32_t side, int32_t times) {
  return (int32_t)(((int64_t)side + ((int64_t)1 << times) - 1) >> times);
}

int32_t cs_pyramid_top(const cs_pyramid *pyramid) {
  int32_t longer = pyramid->width > pyramid->height ? pyramid->width : pyramid->height;
  int32_t top = 0;
  while ((int32_t)1 << top < longer)
    top++;
  return top;
}

void cs_pyramid_size(const cs_pyramid *pyramid, int32_t level, int32_t *width, int32_t *height) {
  int32_t times = cs_pyramid_top(pyramid) - level;
  *width = halved(pyramid->width, times);
  *height = halved(pyramid->height, times);
}

int32_t cs_pyramid_within(const cs_pyramid *pyramid, int32_t side) {
  int32_t level = cs_pyramid_top(pyramid), width, height;
  for (; level > 0; level--) {
    cs_pyramid_size(pyramid, level, &width, &height);
    if (width <= side && height <= side)
      break;
  }
  return level;
}

int32_t cs_pyramid_single(const cs_pyramid *pyramid) {
  return cs_pyramid_within(pyramid, pyramid->tile);
}

/* ---------------------------------------------------------------- tiles */

static int32_t tiles_over(int32_t pixels, int32_t tile) {
  return (int32_t)(((int64_t)pixels + tile - 1) / tile);
}

static int32_t least(int64_t a, int64_t b) { return (int32_t)(a < b ? a : b); }

cs_pyramid_box cs_pyramid_tiles(const cs_pyramid *pyramid, int32_t level,
                                const cs_pyramid_box *region) {
  int32_t width, height, tile = pyramid->tile, times = cs_pyramid_top(pyramid) - level;
  cs_pyramid_size(pyramid, level, &width, &height);
  cs_pyramid_box all = {0, 0, tiles_over(width, tile), tiles_over(height, tile)};
  if (!region)
    return all;
  return (cs_pyramid_box){(region->x0 >> times) / tile, (region->y0 >> times) / tile,
                          least(all.x1, tiles_over(halved(region->x1, times), tile)),
                          least(all.y1, tiles_over(halved(region->y1, times), tile))};
}

cs_pyramid_box cs_pyramid_pixels(const cs_pyramid *pyramid, int32_t level,
                                 const cs_pyramid_box *tiles) {
  int32_t width, height;
  int64_t tile = pyramid->tile, overlap = pyramid->overlap;
  cs_pyramid_size(pyramid, level, &width, &height);
  return (cs_pyramid_box){tiles->x0 > 0 ? (int32_t)(tiles->x0 * tile - overlap) : 0,
                          tiles->y0 > 0 ? (int32_t)(tiles->y0 * tile - overlap) : 0,
                          least(width, tiles->x1 * tile + overlap),
                          least(height, tiles->y1 * tile + overlap)};
}

/* ---------------------------------------------------------------- names */

static bool fits(int length, size_t size) { return length > 0 && (size_t)length < size; }

/* IIIF names a tile by the region of the frame that it shows, in pixels of the frame, and by its
 * size. */
static bool iiif_path(const cs_pyramid *pyramid, cs_pyramid_tile tile, bool is_alias, char *path,
                      size_t size) {
  cs_pyramid_box tiles = {tile.column, tile.row, tile.column + 1, tile.row + 1};
  cs_pyramid_box pixels = cs_pyramid_pixels(pyramid, tile.level, &tiles);
  int32_t times = cs_pyramid_top(pyramid) - tile.level;
  int64_t x = (int64_t)pixels.x0 << times, y = (int64_t)pixels.y0 << times;
  int32_t right = least((int64_t)pixels.x1 << times, pyramid->width);
  int32_t bottom = least((int64_t)pixels.y1 << times, pyramid->height);
  char region[64] = "full";
  if (!is_alias)
    snprintf(region, sizeof region, "%" PRId64 ",%" PRId64 ",%" PRId64 ",%" PRId64, x, y, right - x,
             bottom - y);
  return fits(snprintf(path, size, "%s/%s/%s/%d,%d/0/default.%s", pyramid->folder, pyramid->name,
                       region, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0, pyramid->ending),
              size);
}

bool cs_pyramid_path(const cs_pyramid *pyramid, cs_pyramid_tile tile, bool is_alias, char *path,
                     size_t size) {
  if (is_alias && (pyramid->layout == CS_PYRAMID_DZI || tile.level > cs_pyramid_single(pyramid)))
    return false;
  if (pyramid->layout == CS_PYRAMID_IIIF)
    return iiif_path(pyramid, tile, is_alias, path, size);
  return fits(snprintf(path, size, "%s/%s_files/%d/%d_%d.%s", pyramid->folder, pyramid->name,
                       tile.level, tile.column, tile.row, pyramid->ending),
              size);
}

bool cs_pyramid_tiles_folder(const cs_pyramid *pyramid, char *path, size_t size) {
  return fits(snprintf(path, size, "%s/%s%s", pyramid->folder, pyramid->name,
                       pyramid->layout == CS_PYRAMID_DZI ? "_files" : ""),
              size);
}

celspan_status cs_pyramid_too_long(celspan_context *context, const cs_pyramid *pyramid) {
  return cs_fail(context, CELSPAN_OUTPUT, "%.80s...: the name is too long", pyramid->folder);
}
