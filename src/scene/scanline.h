/* What a scan-line procedure returns on one row: its spans, checked and cut to its bounds.
 *
 * Invariants: spans ascend, do not overlap and lie in the bounds; each has a paint or more; paints
 * are valid. A cut span keeps its own ends for its paints, so that cutting never moves a colour.
 */
#ifndef CS_SCENE_SCANLINE_H
#define CS_SCENE_SCANLINE_H

#include "base/context.h"
#include "colour/paint.h"

typedef struct cs_scanline_span {
  double x0, x1;             /* cut to the bounds; x0 < x1 */
  double paint_x0, paint_x1; /* where the first and the last paint lie */
  size_t first_paint, paint_count;
} cs_scanline_span;

struct celspan_scanline_output {
  celspan_context *context;
  const celspan_scanline_desc *desc;
  double y;
  celspan_status status; /* of the first span that was refused, whatever the procedure made of it */
  size_t emitted;        /* spans given on this row, empty ones and those out of bounds too */
  double last_x1;        /* the end of the one before */
  cs_scanline_span *spans;
  cs_paint *paints;
  size_t span_count, span_capacity;
  size_t paint_count, paint_capacity;
};

void cs_scanline_init(celspan_scanline_output *output);
void cs_scanline_finish(celspan_scanline_output *output, cs_memory *memory);

/* The spans of a procedure at height y, replacing what `output` held. y and row: own units. A row
 * outside the bounds has none, and the procedure is not called.
 * Errors: NO_MEMORY; CALLBACK, naming the span and what is wrong with it; the procedure's own. */
CELSPAN_CHECKED celspan_status cs_scanline_collect(celspan_context *context,
                                                   const celspan_scanline_desc *desc, double y,
                                                   const celspan_scanline_row *row,
                                                   celspan_scanline_output *output);

#endif
