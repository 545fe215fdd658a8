/* A row in the spans of the row above, so that only their ends need be told.
 *
 * On the edge between two runs there are a few raw pixels, now one more, now none; or a few of them
 * happen to be equal. Such a row has other spans than the one above, though it could have the same:
 * with a pixel of a run counted as raw, with short runs and gradients taken as raw pixels, with a
 * run cut in two.
 */
#ifndef SF_FIT_H
#define SF_FIT_H

#include "store.h"

typedef enum sf_fitted {
  SF_FIT_NONE,  /* other spans: *out is of no use */
  SF_FIT_NEAR,  /* the spans of `above` as far as they go together: the next row may fit better */
  SF_FIT_ALIKE, /* the spans of `above`, with other ends */
  SF_FIT_NO_MEMORY
} sf_fitted;

/* Whether the spans are those of `above` as they are, but for their ends. */
bool sf_fit_is_alike(const sf_row *row, const sf_row *above);
/* Makes *out, a row of the same pixels as `row`. */
sf_fitted sf_fit(const sf_memory *memory, spanfile_format format, const sf_row *row,
                 const sf_row *above, sf_row *out);

#endif
