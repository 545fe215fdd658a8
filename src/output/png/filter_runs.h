/* The filters of PNG over rows of runs (output/png/bytes.h says what a filter is). Differences are
 * constant between two places where the row or the row above changes, so they are runs again:
 *
 *   row above      | 5  5  5  5  5  5 | 9  9  9 |
 *   row            | 5  5  5 | 7  7  7  7  7  7 |
 *   Up   x - b     | 0  0  0 | 2  2  2|-2 -2 -2 |       a difference for each column
 *   Sub  x - a       5| 0  0 | 2| 0  0  0  0  0 |       only the first pixel of a run is not 0
 *   Paeth            0| 0  0 | 2| 0  0|-2| 0  0 |       likewise where either row changes
 *
 * INVARIANT: the cost of a row follows its runs and not its width. The filter chosen depends only
 * on the rows since the last restart.
 */
#ifndef CS_OUTPUT_PNG_FILTER_RUNS_H
#define CS_OUTPUT_PNG_FILTER_RUNS_H

#include "deflate/deflate.h"
#include "output/png/bytes.h"

typedef struct cs_png_run {
  int32_t end;    /* column after the last */
  uint64_t pixel; /* as bytes of the file, the first lowest */
} cs_png_run;

/* Runs cover the width; neighbours differ. count 0: no row, as above the first one. */
typedef struct cs_png_runs {
  cs_png_run *runs;
  size_t count, capacity;
} cs_png_runs;

typedef struct cs_png_filter_runs {
  int32_t width;
  size_t pixel_size;
  cs_png_filter last;             /* the last one that was chosen by its cost */
  int kept;                       /* for how many more rows it is kept */
  uint8_t literal_costs[256];     /* of a difference, about, in eighths of a bit */
  cs_deflate_run *differences[2]; /* under two filters, to be compared */
  size_t capacities[2];
} cs_png_filter_runs;

void cs_png_filter_runs_begin(cs_png_filter_runs *filter, int32_t width, size_t pixel_size);
/* Forgets the filters chosen for earlier rows. */
void cs_png_filter_runs_restart(cs_png_filter_runs *filter);
void cs_png_filter_runs_end(cs_png_filter_runs *filter, celspan_context *context);
/* Puts a row: the filter's number and the differences. When there is no row above as runs, only Sub
 * is considered. */
CELSPAN_CHECKED celspan_status cs_png_filter_runs_put(cs_png_filter_runs *filter,
                                                      celspan_context *context,
                                                      const cs_png_runs *row,
                                                      const cs_png_runs *above,
                                                      cs_deflate *deflate);

#endif
