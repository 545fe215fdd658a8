/* A run: neighbouring pixels of one row.
 *
 *        x0                      x1
 *         |                       |
 *     +---+---+---+---+---+---+---+---+
 *     |   | . | . | . | . | . | . |   |   y: the height of the dots
 *     +---+---+---+---+---+---+---+---+
 *
 * Columns are counted from the left edge of the frame, [x0, x1) half open; colours belong to the
 * middle of a pixel, x + 1/2. The height is that at which colours are asked for: the middle of the
 * row, except where a row is made of several heights.
 */
#pragma once

#include <stdint.h>

/* It fits two registers, so it is passed by value. */
typedef struct cs_run {
  int32_t x0, x1; /* columns */
  double y;       /* height in the frame, pixels */
} cs_run;

/* The same row between other columns. */
static inline cs_run cs_run_between(cs_run run, int32_t x0, int32_t x1) {
  return (cs_run){x0, x1, run.y};
}
