/* The tools of a row maker that its filters borrow: area/ for exact means, engine/row/centre.h for
 * pixel centres. All of them outlive the filter, and none of them moves. */
#pragma once

#include "engine/compose/cells.h"
#include "engine/compose/procedures.h"
#include "engine/paint/painter.h"

typedef struct cs_row_tools {
  cs_composer *composer;
  cs_painter *painter; /* of the composer's cells */
  cs_active *active;   /* boundaries at the row's height, in order */
  cs_cells *cells;     /* between them */
  cs_procedures *procedures;
  cs_arena *arena; /* of the current row */
  int32_t width;   /* of the row, pixels */
} cs_row_tools;
