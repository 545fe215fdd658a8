/* What every row of pixel centres does to every boundary, in vector code. */
#ifndef CS_FILTER_CENTRE_H
#define CS_FILTER_CENTRE_H

#include "celspan/celspan.h"
#include "sweep/advance.h"

/* Appends to `ends`, for every visible boundary, the first column whose centre lies at or right of x,
 * held to 0..width; returns how many there are. In whole batches: see sweep/advance.h; of ends too. */
CS_WIDE_DECLARE(size_t, cs_centre_ends,
                (const double *x, const bool *is_visible, size_t count, int32_t width,
                 int32_t *ends));

/* Spans are placed so many at a time: there is room for CS_CENTRE_BATCH more than `count`, of spans
 * and of ends. */
#define CS_CENTRE_BATCH 4

/* Makes span k, a single, cover [ends[k], ends[k + 1]), and leaves its colour. False, and nothing
 * done, where one would be empty. */
CS_WIDE_DECLARE(bool, cs_centre_place,
                (celspan_span *spans, const int32_t *ends, size_t count));

#endif
