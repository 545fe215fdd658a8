/* One worker's scan of a compiled frame: rows of lit spans, in any order, cheapest from top to
 * bottom.
 *
 *   shot --sweep--> active boundaries --compose--> cells --filter--> row of spans
 *
 * Invariant: a row is a function of the shot and its number alone. The scan remembers where it
 * stands only to save work.
 */
#ifndef CS_FILTER_SCAN_H
#define CS_FILTER_SCAN_H

#include "compose/cells.h"
#include "filter/convolve.h"
#include "filter/meetings.h"
#include "filter/window.h"
#include "scene/scanline.h"

/* A rostrum compiled for a frame of some size: made by render/compile.c, never changed after. */
typedef struct cs_shot {
  cs_stack stack;
  cs_boundary_set boundaries;
  cs_cull cull;
  int32_t width, height; /* pixels */
  int32_t margin;        /* pixels beyond the frame, on all sides, that rows may need */
  celspan_antialias_mode antialias;
  cs_kernel *kernel; /* FILTER; owned */
} cs_shot;

#define CS_SCAN_NOWHERE INT32_MIN

typedef struct cs_member cs_member; /* cluster.h */

typedef struct cs_scan {
  celspan_context *context; /* the worker's branch */
  const cs_shot *shot;
  cs_composer composer;
  cs_active active;
  cs_cells cells;
  cs_edges edges; /* of the row being made */
  cs_window window;
  cs_meetings meetings; /* of the cluster being replayed */
  cs_member *members;   /* room for its members */
  void **member_lists;  /* and for three lists of them */
  size_t member_capacity, list_capacity;
  cs_arena arena; /* of the current row */
  celspan_scanline_output output; /* room for what procedures return */
  struct cs_carried *carried; /* of the current row: see carry.h */
  uint64_t looks;   /* how often the cells have changed */
  cs_change change; /* where they did last */
  int32_t row;    /* the active boundaries stand at this row's height, or NOWHERE */
  cs_trace *traces; /* FILTER: of rows seen, row y in place y modulo the count */
  const cs_trace **under; /* those under the kernel */
  size_t trace_count;
  cs_convolve convolve;
} cs_scan;

CELSPAN_CHECKED celspan_status cs_scan_init(cs_scan *scan, celspan_context *context,
                                            const cs_shot *shot);
void cs_scan_finish(cs_scan *scan);
/* The spans of row y, 0 <= y < height: they cover [0, width). What out holds is given up, or made
 * this row where little changed since this scan made it.
 * Errors: NO_MEMORY, INPUT, LIMIT, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_scan_row(cs_scan *scan, int32_t y, cs_row *out);

/* ---- the three ways from cells to pixels */

/* Pixel centres: the boundaries stand at y + 1/2. Clears out, or patches what it made of it. */
CELSPAN_CHECKED celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out);
/* The exact mean over each pixel: the boundaries stand at y, and at y + 1 when it returns. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_scan *scan, int32_t y, cs_row *out);

/* Through a kernel: swept are the rows under it that were not kept from the row before. */
CELSPAN_CHECKED celspan_status cs_traces_row(cs_scan *scan, int32_t y, cs_row *out);
CELSPAN_CHECKED celspan_status cs_traces_init(cs_scan *scan);
void cs_traces_finish(cs_scan *scan);
/* Sweeps any row, those beyond the frame too, into a trace. */
CELSPAN_CHECKED celspan_status cs_scan_trace(cs_scan *scan, int32_t row, cs_trace *trace);

#endif
