/* The exact mean of a pixel in which several drawings are broken.
 *
 *     y0  +---------\----/--+
 *         |          \  /   |     heights at which a line begins or ends, or lines of two drawings
 *         |- - - - - -\/- - |     cross: between two of them the lines keep their order, so that
 *         |           /\    |     what lies between two lines is a trapezoid, of one colour
 *     y1  +----------/--\---+
 *
 * Where two drawings are broken, they need not be cut: a fold is linear in each of its layers, so
 * the mean is the fold of the means, corrected by the relation between the lines of the two. For
 * lines k and l the correction is the area right of both, less the product of the areas right of
 * each:
 *
 *     +--------\--/-----+
 *     |   k     \/  l   |     #: right of both
 *     |         /\######|
 *     +--------/--\#####+
 *
 * Invariant: the mean is exact except for rounding, unless more than CS_MAP_EXACT_LINES lines meet:
 * then it is the mean of CS_MAP_EXACT_LINES heights, spaced evenly.
 */
#pragma once

#include "engine/map/brush.h"
#include "engine/map/sheets.h"
#include "model/geometry/segment.h"

#define CS_MAP_EXACT_LINES 48

/* The change at a piece of a border in the pixel. x and y count from the pixel's upper left
 * corner. */
typedef struct cs_map_line {
  cs_segment at;
  cs_v4 step;     /* right less left */
  cs_v4 through;  /* the same for the light let through */
  uint32_t sheet; /* of the list */
} cs_map_line;

typedef struct cs_map_exact {
  cs_map_line *lines;
  double *heights;
  cs_map_line **order;
  bool is_coloured; /* a drawing among them is; else steps say how much more is let through */
  size_t line_count, line_capacity, height_count, height_capacity, order_capacity;
} cs_map_exact;

/* One of the drawings that can be shown in the pixel. */
typedef struct cs_map_shown {
  const cs_map_sheet *sheet;
  /* The mean, or for cs_map_exact_mean that at the pixel's left edge. */
  cs_v4 colour, through;
} cs_map_shown;

void cs_map_exact_finish(cs_map_exact *exact, cs_memory *memory);
/* Removes the lines. */
static inline void cs_map_exact_clear(cs_map_exact *exact) {
  exact->line_count = 0;
  exact->is_coloured = false;
}
/* Adds the lines of a broken drawing to those of the pixel (column, row). index: of the drawing
 * among those shown; from: the column from which on it is broken. Errors: NO_MEMORY, and those of
 * painting. */
CELSPAN_CHECKED celspan_status cs_map_exact_add(celspan_context *context, cs_map_exact *exact,
                                                cs_map_rows *rows, uint32_t index, int32_t from,
                                                int32_t column, int32_t row);
/* The mean where two drawings are broken, whose lines have been added; the lines are then removed.
 * The means of all drawings that are shown are given. */
cs_v4 cs_map_exact_pair(cs_map_exact *exact, const cs_map_frame *frame, const cs_map_shown *shown,
                        size_t count);
/* The mean of all that is shown, from the camera on, with the lines that have been added; the lines
 * are then removed. opaque: nothing shines through the last one. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_exact_mean(celspan_context *context, cs_map_exact *exact,
                                                 const cs_map_frame *frame,
                                                 const cs_map_shown *shown, size_t count,
                                                 cs_v4 *out);
