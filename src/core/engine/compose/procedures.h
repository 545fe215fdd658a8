/* Procedures: scan-line primitives on a row. The spans that a procedure returns enter the row as
 * pairs of upright edges beside the swept boundaries, so they take part in booleans, lights and
 * antialiasing like any other primitive.
 *
 *     height of the row ---- span of a procedure: [x0, x1) --------
 *                                 |                     |
 *                        edge: direction +1      edge: direction -1
 *
 * A procedure is called at the pixel centres under antialias "none". Under "area" it is called at
 * CS_PROCEDURES_ROWS heights of a row, and each of its spans lasts for that share of the row.
 *
 * Invariant: the edges lie in the frame and its margin, and the composer has the spans they name
 * until its next row begins.
 */
#pragma once

#include "base/arena.h"
#include "engine/compose/composer.h"
#include "model/scene/scanline.h"

#define CS_PROCEDURES_ROWS 16

typedef struct cs_procedures {
  cs_composer *composer;          /* borrowed: gets the spans of the row */
  cs_arena *arena;                /* borrowed: of the row, for paints and edges */
  int32_t width, margin;          /* the width and margin of the frame, in pixels */
  celspan_scanline_output output; /* room for the result of one call of a procedure */
} cs_procedures;

typedef struct cs_procedure_edge {
  double x; /* clamped to the frame and its margin */
  uint32_t layer, span;
  int32_t direction; /* +1 where the span begins, -1 where it ends */
} cs_procedure_edge;

typedef struct cs_procedure_edges {
  cs_procedure_edge *edges;
  size_t count, capacity;
} cs_procedure_edges;

void cs_procedures_init(cs_procedures *procedures, cs_composer *composer, cs_arena *arena,
                        int32_t width, int32_t margin);
void cs_procedures_finish(cs_procedures *procedures, cs_memory *memory);
/* Whether a scan-line primitive may be visible on row y. */
bool cs_procedures_meet(const cs_procedures *procedures, int32_t y);
/* Calls every procedure at a height of the frame. Appends its spans to the composer's, and
 * their edges to `edges`, in no order; they are valid until the arena is reset. Errors: NO_MEMORY;
 * CALLBACK and what procedures return. */
CELSPAN_CHECKED celspan_status cs_procedures_collect(cs_procedures *procedures, double height,
                                                     cs_procedure_edges *edges);
/* Puts the edges in order from left to right. */
void cs_procedures_sort(cs_procedure_edges *edges);
