/* A sink that converts the rows of a frame to planes of Y'CbCr for an encoder of eight bits.
 *
 *   spans -> a row of RGBA --> y y y y y y      then all cb, then all cr: a row of each (4:4:4),
 *            (two rows, kept)  y y y y y y      or of two rows one of half the width (4:2:0)
 *
 * This is a third of the bytes of RGBA, and ffmpeg does not convert colours. An odd width or height
 * is rounded up: the last pixel or row then counts twice.
 */
#pragma once

#include "output/sinks/coder.h"

typedef struct cs_ycc {
  cs_coder coder;       /* the coder of 8 bits */
  bool is_halved;       /* 4:2:0 */
  unsigned char *bytes; /* the bytes of all planes; borrowed */
  int32_t width, height;
  uint32_t *rows; /* two rows of the thread that began the sink */
} cs_ycc;

/* Bytes of all planes. */
size_t cs_ycc_size(int32_t width, int32_t height, bool is_halved);
/* ycc: all fields up to `bytes` are set; must live as long as the sink. */
celspan_sink cs_ycc_sink(cs_ycc *ycc);
