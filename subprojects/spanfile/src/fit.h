/* A row expressed by the same spans as the row above, so that only their ends have to be stored.
 *
 * On the edge between two runs there are usually a few raw pixels, sometimes none; or some of them
 * happen to be equal. Such a row has other spans than the row above, but it could have the same:
 *
 *   above    |  run A  |raw|  run B  |
 *   row      |  run A   |   run B    |        no raw pixel on the edge
 *   fitted   |  run A   |r|  run B   |        the first pixel of run B counts as raw
 *
 * Likewise a short run or gradient can count as raw pixels, and a run can be cut in two.
 *
 * INVARIANT: the fitted row has the same pixels as the row.
 */
#pragma once

#include "store.h"

typedef enum sf_fitted {
  SF_FIT_NONE,  /* *out is useless: it costs more than the row itself */
  SF_FIT_NEAR,  /* *out has some spans of `above`, so the next row may fit it better than the row */
  SF_FIT_ALIKE, /* *out has the spans of `above`, with other ends */
  SF_FIT_NO_MEMORY
} sf_fitted;

/* Whether the row has the spans of `above`, except for their ends. */
bool sf_fit_is_alike(const sf_row *row, const sf_row *above);
/* Makes *out, a row of the same pixels as `row`. */
sf_fitted sf_fit(const sf_memory *memory, spanfile_format format, const sf_row *row,
                 const sf_row *above, sf_row *out);
