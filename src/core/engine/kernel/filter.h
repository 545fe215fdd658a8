/* Rows through a filter kernel: the retained edges of the rows under it are kept in a ring, so that
 * on the way down each row is swept once, and are then summed by the kernel.
 *
 *     row y - 1   --+   |  ring of retained rows: row y is in place y modulo their number
 *     row y         +-- kernel of row y  --convolve--> spans of row y
 *     row y + 1   --+   |
 *     row y + 2             swept only when a row's kernel extends to it
 *
 * Invariant: a retained row is a function of the plan and its number, so it does not matter whether
 * it was kept or has been swept again.
 */
#pragma once

#include "engine/kernel/convolve_parts.h"

/* Sweeps any row, also beyond the frame, and keeps its edges. */
typedef celspan_status cs_filter_retain(void *user, int32_t y, cs_retained_row *retained);

typedef struct cs_filter {
  const cs_kernel *kernel; /* borrowed; NULL: the filter was never begun */
  cs_painter *painter;     /* borrowed */
  cs_filter_retain *retain;
  void *user; /* for retain */
  CS_ARRAY(cs_retained_row, rows);
  CS_ARRAY(const cs_retained_row *, under); /* the rows under the kernel, from the topmost down */
  size_t row_count;                         /* the number of rows, and of places in under */
  cs_convolve convolve;
} cs_filter;

/* kernel, painter: borrowed. width: of the row, in pixels. The filter must be finished
 * after a failure too. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_filter_init(cs_filter *filter, const cs_kernel *kernel,
                                              cs_painter *painter, int32_t width,
                                              cs_filter_retain *retain, void *user);
void cs_filter_finish(cs_filter *filter, cs_memory *memory);
/* Row y, into an empty row. Errors: NO_MEMORY and the errors of retain. */
CELSPAN_CHECKED celspan_status cs_filter_row(cs_filter *filter, int32_t y, cs_row *out);
