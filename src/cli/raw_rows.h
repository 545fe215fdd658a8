/* A sink that writes the rows of a frame to a stream as coded pixels, without any file format. One
 * row is kept in memory.
 */
#ifndef CS_CLI_RAW_ROWS_H
#define CS_CLI_RAW_ROWS_H

#include <stdio.h>

#include "celspan/celspan.h"

typedef struct cs_raw_rows {
  celspan_coding coding; /* without defaults, but for the depth of dithering */
  int32_t x, y;          /* the place of the first pixel in the whole frame */
  FILE *stream;
  unsigned char *row;
  size_t row_size;
} cs_raw_rows;

/* A sink that codes rows of the frame with `coding` (defaults as for raw frames) and writes them to
 * `stream`. raw: kept by the sink as long as it is used. */
celspan_sink cs_raw_rows_sink(cs_raw_rows *raw, const celspan_coding *coding,
                              const celspan_frame_desc *frame, FILE *stream);

#endif
