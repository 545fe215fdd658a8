/* The levels of a few hundred pixels a side and less, down to one pixel.
 *
 * Each of their pixels is the mean over the part of a larger level, the base, that it covers, in
 * linear light and premultiplied. If they were rendered from the scene, each of a handful of pixels
 * would have to process every boundary of the scene.
 */
#ifndef CS_CLI_TILES_MEANS_H
#define CS_CLI_TILES_MEANS_H

#include "cli/tiles/rows.h"

enum {
  CS_TILE_MEANS_BASE = 1024, /* pixels a side, at most, of the base */
  CS_TILE_MEANS_SIDE = 255   /* of a level that is a mean */
};

typedef struct cs_tile_means {
  int32_t width, height;
  float *pixels; /* RGBA; NULL: not begun */
} cs_tile_means;

/* Makes room for the base, and the sink that fills it. */
CELSPAN_CHECKED celspan_status cs_tile_means_begin(celspan_context *context, int32_t width,
                                                   int32_t height, cs_tile_means *out,
                                                   celspan_sink *sink);
/* Feeds a level of width x height pixels to a sink. */
CELSPAN_CHECKED celspan_status cs_tile_means_render(celspan_context *context,
                                                    const cs_tile_means *base, int32_t width,
                                                    int32_t height, const celspan_sink *sink);
void cs_tile_means_free(celspan_context *context, cs_tile_means *base);

#endif
