/* The exact mean of a pixel in which several drawings are broken.
 *
 *     y0  +---------\----/--+
 *         |          \  /   |     heights at which a line begins or ends, or at which lines of two
 *         |- - - - - -\/- - |     drawings cross. Between two such heights the lines keep their
 *         |           /\    |     order, so the area between two lines is a trapezoid of one colour
 *     y1  +----------/--\---+
 *
 * Where only two drawings are broken, the pixel need not be cut at such heights. A fold is linear
 * in each of its layers, so the mean is the fold of the means of the drawings, with a correction
 * for each line k of one drawing and each line l of the other drawing. The correction is the area
 * right of both lines, less the product of the area right of k and the area right of l:
 *
 *     +--------\--/-----+
 *     |   k     \/  l   |     #: right of both
 *     |         /\######|
 *     +--------/--\#####+
 *
 * Invariant: the mean is exact except for rounding. If more than CS_MAP_EXACT_LINES lines meet, it
 * is the mean of CS_MAP_EXACT_LINES evenly spaced heights instead.
 */
#pragma once

#include "engine/map/brush.h"
#include "engine/map/sheets.h"
#include "engine/map/swath.h"
#include "model/geometry/segment.h"

#define CS_MAP_EXACT_LINES 48

/* The change at a piece of a border in the pixel. x and y count from the pixel's upper left
 * corner. */
typedef struct cs_map_line {
  cs_segment at;
  cs_v4 step;     /* the colour on the right less the colour on the left */
  cs_v4 through;  /* the difference of the transmissions */
  uint32_t sheet; /* the sheet of the list */
} cs_map_line;

typedef struct cs_map_exact {
  CS_ARRAY(cs_map_line, lines);
  CS_ARRAY(double, heights);
  CS_ARRAY(cs_map_line *, order);
  bool is_coloured; /* one of the drawings is coloured; else -step[3] is the transmission */
  size_t line_count, height_count;
} cs_map_exact;

/* One of the drawings that can be shown in the pixel. */
typedef struct cs_map_shown {
  const cs_map_sheet *sheet;
  /* The mean; for cs_map_exact_mean, the values at the pixel's left edge. */
  cs_v4 colour, through;
} cs_map_shown;

void cs_map_exact_finish(cs_map_exact *exact, cs_memory *memory);
/* Removes the lines. */
static inline void cs_map_exact_clear(cs_map_exact *exact) {
  exact->line_count = 0;
  exact->is_coloured = false;
}
/* Adds the lines of a broken drawing to the lines of the pixel (column, row). index: the number of
 * the drawing among the drawings that are shown; from: the column from which on it is broken.
 * Errors: NO_MEMORY, and the errors of painting. */
CELSPAN_CHECKED celspan_status cs_map_exact_add(celspan_context *context, cs_map_exact *exact,
                                                cs_map_rows *rows, uint32_t index, int32_t from,
                                                int32_t column, int32_t row);
/* The mean where two drawings are broken whose lines have been added. The means of all drawings
 * that are shown are known. Removes the lines. */
cs_v4 cs_map_exact_pair(cs_map_exact *exact, const cs_map_frame *frame, const cs_map_shown *shown,
                        size_t count);
/* The mean of everything that is shown, from the camera on, with the lines that have been added.
 * Removes the lines. opaque: nothing shines through the last drawing. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_exact_mean(celspan_context *context, cs_map_exact *exact,
                                                 const cs_map_frame *frame,
                                                 const cs_map_shown *shown, size_t count,
                                                 cs_v4 *out);

/* ---- near.c */

#define CS_MAP_TILE 32 /* columns */

/* Finds the bits of the rows' swath, unless they are known. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_near_find(celspan_context *context, cs_map_rows *rows);

/* A bit for each of the 64 borders from 64 * word on: whether it is near the columns [first,
 * last]. */
static inline uint64_t cs_map_near_word(const cs_map_rows *rows, size_t word, int32_t first,
                                        int32_t last) {
  uint64_t bits = 0;
  for (int32_t tile = first / CS_MAP_TILE; tile <= last / CS_MAP_TILE; tile++)
    bits |= rows->near[(size_t)tile * rows->near_words + word];
  return bits;
}
