/* Levels of a few hundred pixels and less, down to one.
 *
 * They are means of the pixels of a larger level, in linear light and premultiplied, over exactly
 * the part of it that a pixel covers. Rendered from the scene, a handful of pixels would each hold
 * every boundary of it.
 */
#ifndef CS_CLI_TILES_SMALL_H
#define CS_CLI_TILES_SMALL_H

#include "cli/tiles/rows.h"

enum {
  CS_TILE_SMALL_BASE = 1024, /* pixels a side, at most, of the level that is rendered for them */
  CS_TILE_SMALL_SIDE = 255   /* of a level that is a mean */
};

typedef struct cs_tile_small {
  int32_t width, height;
  float *pixels; /* RGBA; NULL: not begun */
} cs_tile_small;

/* Room for the level that the others are means of, and the sink that fills it. */
CELSPAN_CHECKED celspan_status cs_tile_small_begin(celspan_context *context, int32_t width,
                                                   int32_t height, cs_tile_small *out,
                                                   celspan_sink *sink);
/* Feeds a level of width x height pixels to a sink. */
CELSPAN_CHECKED celspan_status cs_tile_small_render(celspan_context *context,
                                                    const cs_tile_small *small, int32_t width,
                                                    int32_t height, const celspan_sink *sink);
void cs_tile_small_free(celspan_context *context, cs_tile_small *small);

#endif
