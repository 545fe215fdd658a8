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
#include "filter/window.h"

/* A rostrum compiled for a frame of some size: made by render/compile.c, never changed after. */
typedef struct cs_shot {
  cs_stack stack;
  cs_boundary_set boundaries;
  int32_t width, height; /* pixels */
  celspan_antialias_mode antialias;
} cs_shot;

typedef struct cs_scan {
  celspan_context *context; /* the worker's branch */
  const cs_shot *shot;
  cs_composer composer;
  cs_active active;
  cs_cells cells;
  cs_window window;
  cs_arena arena; /* of the current row */
  int32_t row;    /* the active boundaries stand at this row's height; -1: nowhere */
} cs_scan;

CELSPAN_CHECKED celspan_status cs_scan_init(cs_scan *scan, celspan_context *context,
                                            const cs_shot *shot);
void cs_scan_finish(cs_scan *scan);
/* The spans of row y, 0 <= y < height: they cover [0, width). out is cleared first.
 * Errors: NO_MEMORY, INPUT, LIMIT, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_scan_row(cs_scan *scan, int32_t y, cs_row *out);

/* ---- the two ways from cells to pixels */

/* Pixel centres: the boundaries stand at y + 1/2. */
CELSPAN_CHECKED celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out);
/* The exact mean over each pixel: the boundaries stand at y, and at y + 1 when it returns. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_scan *scan, int32_t y, cs_row *out);

#endif
