/* One worker's scan of a compiled frame: rows of lit spans, in any order, cheapest from top to
 * bottom.
 *
 *   shot --sweep--> active boundaries --compose--> cells --filter--> row of spans
 *
 * Invariant: a row is a function of the shot and its number alone. The scan remembers where it
 * stands only to save work.
 */
#ifndef CS_ROW_ROW_H
#define CS_ROW_ROW_H

#include "area/intersections.h"
#include "area/window.h"
#include "compose/cells.h"
#include "kernel/convolve.h"
#include "scene/scanline.h"

/* A rostrum compiled for a frame of some size: made by render/compile.c, never changed after. */
typedef struct cs_plan {
  cs_stack stack;
  cs_boundary_set boundaries;
  cs_cull cull;
  int32_t width, height; /* pixels */
  int32_t margin;        /* pixels beyond the frame, on all sides, that rows may need */
  celspan_antialias_mode antialias;
  cs_kernel *kernel; /* FILTER; owned */
} cs_plan;

#define CS_ROW_NOWHERE INT32_MIN

typedef struct cs_member cs_member; /* cluster.h */

typedef struct cs_row_maker {
  celspan_context *context; /* the worker's branch */
  const cs_plan *plan;
  cs_composer composer;
  cs_painter painter; /* of its cells */
  cs_active active;
  cs_cells cells;
  cs_edges edges; /* of the row being made */
  cs_window window;
  cs_intersections intersections; /* of the cluster being replayed */
  cs_member *members;             /* room for its members */
  void **member_lists;            /* and for three lists of them */
  size_t member_capacity, list_capacity;
  cs_arena arena;                 /* of the current row */
  celspan_scanline_output output; /* room for what procedures return */
  struct cs_committed *committed; /* of the current row: see carry.h */
  uint64_t looks;                 /* how often the cells have changed */
  cs_change change;               /* where they did last */
  int32_t row;                    /* the active boundaries stand at this row's height, or NOWHERE */
  cs_retained_row *retained_rows; /* FILTER: of rows seen, row y in place y modulo the count */
  const cs_retained_row **under;  /* those under the kernel */
  size_t retained_count;
  cs_convolve convolve;
} cs_row_maker;

CELSPAN_CHECKED celspan_status cs_row_maker_init(cs_row_maker *maker, celspan_context *context,
                                                 const cs_plan *plan);
void cs_row_maker_finish(cs_row_maker *maker);
/* The spans of row y, 0 <= y < height: they cover [0, width). What out holds is given up, or made
 * this row where little changed since this scan made it.
 * Errors: NO_MEMORY, INPUT, LIMIT, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_row_make(cs_row_maker *maker, int32_t y, cs_row *out);

/* ---- the three ways from cells to pixels */

/* Pixel centres: the boundaries stand at y + 1/2. Clears out, or patches what it made of it. */
CELSPAN_CHECKED celspan_status cs_centre_row(cs_row_maker *maker, int32_t y, cs_row *out);
/* The exact mean over each pixel: the boundaries stand at y, and at y + 1 when it returns. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_row_maker *maker, int32_t y, cs_row *out);

/* Through a kernel: swept are the rows under it that were not kept from the row before. */
CELSPAN_CHECKED celspan_status cs_filter_row(cs_row_maker *maker, int32_t y, cs_row *out);
CELSPAN_CHECKED celspan_status cs_filter_init(cs_row_maker *maker);
void cs_filter_finish(cs_row_maker *maker);
/* Sweeps any row, those beyond the frame too, into a trace. */
CELSPAN_CHECKED celspan_status cs_row_retain(cs_row_maker *maker, int32_t row,
                                             cs_retained_row *retained);

#endif
