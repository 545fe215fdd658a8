/* Antialias "none": a pixel shows the cell that its centre is in.
 *
 * Rows that follow each other are often the same cells between boundaries that have moved a little.
 * So a row that this filter has filled, and nobody else has written to since (engine/span/row.h:
 * made_by), keeps its colours: only the cells that have changed since write theirs. `changes`
 * counts how often the cells have changed, and the row notes the count at which it was filled.
 */
#pragma once

#include "engine/area/row_tools.h"
#include "engine/span/row.h"

typedef struct cs_centre {
  cs_row_tools tools;    /* borrowed */
  uint64_t changes;      /* how often the cells have changed so far */
  cs_change last_change; /* where the cells changed last */
} cs_centre;

void cs_centre_init(cs_centre *centre, const cs_row_tools *tools);
/* Notes that the cells are about to change. Must be called before each row is made. */
static inline void cs_centre_note_change(cs_centre *centre, cs_change change) {
  centre->changes++;
  centre->last_change = change;
}
/* Row y; the boundaries and cells are at its centre. out: is replaced. */
CELSPAN_CHECKED celspan_status cs_centre_row(cs_centre *centre, int32_t y, cs_row *out);

/* ---- centre_wide.c: what every such row does to every boundary, in vector code
 *
 * A visible boundary at x begins a cell with the first column whose centre lies at or right of x,
 * clamped to 0..width. Fills ends with where the visible cells of a row end, and makes the spans of
 * their numbers singles that lie there; colours are not written. Returns how many there are, or 0
 * where one is empty. x and is_visible: of all boundaries, in whole batches
 * (engine/sweep/advance.h), and there is room for a batch of spans and ends beyond the last. */
CS_WIDE_DECLARE(size_t, cs_centre_place,
                (const double *x, const bool *is_visible, size_t count, int32_t width,
                 celspan_span *spans, int32_t *ends));
