/* Pixels that hang together, by sides or corners: blots of ink, specks of dust, holes.
 *
 *      . # # . . #        runs of rows, each with the number of its blot:
 *      . . . # . #        one blot of three pixels, and one of two
 *
 * INVARIANT: blots are numbered in the order of their first pixels, from the top left.
 */
#pragma once

#include "inside/context.h"

typedef struct cs_blot_run {
  int32_t y, x0, x1; /* x0 .. x1 - 1 */
  uint32_t blot;
} cs_blot_run;

typedef struct cs_blot {
  uint32_t area;
  int32_t x0, y0, x1, y1; /* x1, y1: not counted */
} cs_blot;

typedef struct cs_blots {
  cs_blot_run *runs;
  cs_blot *list;
  size_t run_count, run_capacity, count, capacity;
} cs_blots;

/* Of the bytes that are not 0. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_blots_find(celspan_context *context, const uint8_t *plane,
                                             int32_t width, int32_t height, cs_blots *out);
void cs_blots_finish(cs_blots *blots, celspan_context *context);
