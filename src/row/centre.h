/* What every row of pixel centres does to every boundary, in vector code. */
#ifndef CS_ROW_CENTRE_H
#define CS_ROW_CENTRE_H

#include "celspan/celspan.h"
#include "sweep/advance.h"

/* A visible boundary at x begins a cell with the first column whose centre lies at or right of x,
 * held to 0..width. Fills ends with where the visible cells of a row end, and makes the spans of
 * their numbers singles that lie there; their colours are left. Returns how many there are, or 0
 * where one is empty.
 * x and is_visible: of all boundaries, in whole batches (sweep/advance.h), and there is room for a
 * batch of spans and ends beyond the last. */
CS_WIDE_DECLARE(size_t, cs_centre_place,
                (const double *x, const bool *is_visible, size_t count, int32_t width,
                 celspan_span *spans, int32_t *ends));

#endif
