/* A sink that makes planes of Y'CbCr of the rows of a frame, as an encoder of eight bits takes them.
 *
 *   spans -> a row of RGBA --> y y y y y y      then all cb, then all cr: of each row a row (4:4:4),
 *            (two rows, kept)  y y y y y y      or of two rows one of half the width (4:2:0)
 *
 * A third of the bytes go through the pipe, and ffmpeg has no colours to convert. An odd width or
 * height is rounded up: the last pixel, or row, then stands for two.
 */
#ifndef CS_CLI_VIDEO_PLANES_H
#define CS_CLI_VIDEO_PLANES_H

#include "celspan/celspan.h"

typedef struct cs_planes {
  celspan_coding coding; /* without defaults, but for the depth of dithering */
  int32_t x, y;          /* the place of the first pixel in the whole frame */
  bool is_halved;        /* 4:2:0 */
  int32_t width, height;
  unsigned char *bytes; /* of all planes; borrowed */
  uint32_t *rows[2];    /* the even and the odd row; rows[0] owned, one block */
} cs_planes;

/* The bytes of all planes. */
size_t cs_planes_size(int32_t width, int32_t height, bool is_halved);
/* coding: of 8 bits. bytes: cs_planes_size. planes: kept by the sink as long as it is used. */
celspan_sink cs_planes_sink(cs_planes *planes, const celspan_coding *coding,
                            const celspan_frame_desc *frame, bool is_halved, unsigned char *bytes);

#endif
