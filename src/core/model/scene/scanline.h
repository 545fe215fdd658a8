/* The spans that a scan-line procedure gives for one row, checked and cut to its bounds.
 *
 *            bounds.x                                  bounds.x + width
 *               |      x0         x1                        |
 *               |       +---------+                +--------|........
 *               |       p    p    p                p        |       p
 *               |                                  x0      x1      paint_x1
 *
 * The paints p of a span lie at equal distances from its first end to its last.
 *
 * Invariants: spans ascend, do not overlap and lie in the bounds; each has at least one paint; all
 * paints are valid. A span that is cut keeps the ends of its paints, so cutting moves no colour.
 */
#pragma once

#include "base/arrays.h"
#include "model/colour/paint.h"

typedef struct cs_scanline_span {
  double x0, x1;             /* cut to the bounds; x0 < x1 */
  double paint_x0, paint_x1; /* where the first and the last paint lie */
  size_t first_paint, paint_count;
} cs_scanline_span;

struct celspan_scanline_output {
  celspan_context *context;
  const celspan_scanline_desc *desc;
  double y;
  celspan_status status; /* why the first span was refused, even if the procedure ignores it */
  size_t emitted;        /* spans given on this row, empty ones and those out of bounds too */
  double last_x1;        /* the end of the previous span */
  CS_ARRAY(cs_scanline_span, spans);
  CS_ARRAY(cs_paint, paints);
  size_t span_count, paint_count;
};

void cs_scanline_init(celspan_scanline_output *output);
void cs_scanline_finish(celspan_scanline_output *output, cs_memory *memory);

/* Fills `output` with the spans of a procedure at height y. y and row: in the procedure's own
 * units. At a height outside the bounds there are none, and the procedure is not called. Errors:
 * NO_MEMORY; CALLBACK, naming the span and the mistake; the errors of the procedure. */
CELSPAN_CHECKED celspan_status cs_scanline_collect(celspan_context *context,
                                                   const celspan_scanline_desc *desc, double y,
                                                   const celspan_scanline_row *row,
                                                   celspan_scanline_output *output);
