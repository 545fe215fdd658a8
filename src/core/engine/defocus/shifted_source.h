/* The rows of nodes of a grid that is read along a shift.
 *
 *     row y - 1 read    |-------------|          bands of rows; those that the last row did not
 *     row y reads            |-------------|     read are released when the next one begins
 *     bands held      | 3 |    4    |    5    |
 */
#pragma once

#include "engine/sample/defocused.h"

typedef struct cs_shifted_source {
  const cs_defocused *grid;
  CS_ARRAY(const float *, rows); /* the rows of plane 0, where their bands are held */
  CS_ARRAY(cs_defocus_band *, bands);
  size_t plane;                  /* floats from a row to the same one of the next plane */
  cs_defocused_range held, used; /* bands: some of them may be held; the current row reads these */
} cs_shifted_source;

/* grid: NULL: there is nothing to read. Must be ended after a failure too. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shifted_source_begin(celspan_context *context,
                                                       const cs_defocused *grid,
                                                       cs_shifted_source *out);
void cs_shifted_source_end(celspan_context *context, cs_shifted_source *source);
/* Begins the next row of the frame. */
void cs_shifted_source_next(celspan_context *context, cs_shifted_source *source);
/* Acquires the rows around heights from `low` to `high`, which may lie anywhere. Errors: those of
 * the bands. */
CELSPAN_CHECKED celspan_status cs_shifted_source_take(celspan_context *context,
                                                      cs_shifted_source *source, double low,
                                                      double high);
