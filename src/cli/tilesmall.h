/* The levels below the one that fits into a single tile, down to one pixel.
 *
 * They are means of that level's pixels, in linear light and premultiplied, over exactly the part of
 * it that a pixel covers. Rendered from the scene, a handful of pixels would each hold every
 * boundary of it.
 */
#ifndef CS_CLI_TILESMALL_H
#define CS_CLI_TILESMALL_H

#include "cli/tilerows.h"

typedef struct cs_tilesmall {
  int32_t width, height;
  float *pixels; /* RGBA; NULL: not made yet */
} cs_tilesmall;

/* frame: of the level that fits into a single tile. */
CELSPAN_CHECKED celspan_status cs_tilesmall_make(celspan_context *context,
                                                 const celspan_frame_desc *frame,
                                                 cs_tilesmall *out);
/* Feeds a level of width x height pixels to a sink. */
CELSPAN_CHECKED celspan_status cs_tilesmall_render(celspan_context *context,
                                                   const cs_tilesmall *small, int32_t width,
                                                   int32_t height, const celspan_sink *sink);
void cs_tilesmall_free(celspan_context *context, cs_tilesmall *small);

#endif
