/* The tools that a row maker lends to its filters: area/ for exact means, engine/row/centre.h for
 * pixel centres. They live longer than the filters, and their addresses do not change. */
#pragma once

#include "engine/compose/cells.h"
#include "engine/compose/procedures.h"
#include "engine/paint/painter.h"

typedef struct cs_row_tools {
  cs_composer *composer;
  cs_painter *painter; /* the painter of the composer's cells */
  cs_active *active;   /* boundaries at the row's height, in order */
  cs_cells *cells;     /* the cells between boundaries */
  cs_procedures *procedures;
  cs_arena *arena; /* the arena of the current row */
  int32_t width;   /* the width of the row, pixels */
} cs_row_tools;
