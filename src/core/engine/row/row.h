/* Rows of a frame: one worker makes them from its plan, in any order, cheapest from top to bottom.
 *
 *   plan --sweep--> active boundaries --compose--> cells --one of three filters--> row of spans
 *
 * Invariant: a row is a function of the plan and its number alone. The state that a row maker keeps
 * from row to row only saves work.
 */
#pragma once

#include "engine/area/area.h"
#include "engine/kernel/filter.h"
#include "engine/row/centre.h"
#include "engine/row/plan.h"

#define CS_ROW_NONE INT32_MIN

/* Its members point to each other, so it must not be moved. */
typedef struct cs_row_maker {
  celspan_context *context; /* borrowed: the worker's branch */
  const cs_plan *plan;      /* borrowed */
  cs_active active;         /* the boundaries that the current height crosses, in order */
  cs_composer composer;
  cs_cells cells;     /* the cells between the boundaries */
  cs_painter painter; /* the painter of the cells */
  cs_procedures procedures;
  cs_arena arena; /* the arena of the current row */
  int32_t row;    /* the row at whose height the boundaries are; NONE: at none yet */
  /* the three filters */
  cs_centre centre;
  cs_area area;
  cs_filter filter;
} cs_row_maker;

CELSPAN_CHECKED celspan_status cs_row_maker_init(cs_row_maker *maker, celspan_context *context,
                                                 const cs_plan *plan);
void cs_row_maker_finish(cs_row_maker *maker);
/* The spans of row y, 0 <= y < height: they cover [0, width). The contents of `out` are replaced;
 * if this maker made these contents and little has changed since, only the changes are written.
 * Errors: NO_MEMORY, INPUT, LIMIT, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_row_make(cs_row_maker *maker, int32_t y, cs_row *out);
/* Forgets the last row, so that the next one begins from nothing. Needed after a row that
 * failed. */
void cs_row_maker_restart(cs_row_maker *maker);
/* Keeps the visible edges of any row, those beyond the frame too. After an error the maker must be
 * restarted. */
CELSPAN_CHECKED celspan_status cs_row_retain(cs_row_maker *maker, int32_t y,
                                             cs_retained_row *retained);
