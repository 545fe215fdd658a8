/* Rows of spans to filtered rows of PNG bytes (PNG 3rd edition, 7 and 9), into a deflate stream.
 *
 *                     +--> runs --filtered-------+
 *   spans --code------+        (only if needed) +--> deflate
 *                     +--> bytes --filtered-----+
 *
 *   pixels    coded (output/sinks/pixels.h)     in the file
 *   8 bits    R G B A                     R G B A, or R G B of an opaque picture
 *   16 bits   rR gG bB aA (low, high)     Rr Gg Bb Aa, or Rr Gg Bb
 *
 * A row is stored as runs of equal pixels; or as plain bytes, when an eighth of it or more lies in
 * long gradients and arrays. Runs are filtered without being laid out, so the cost of such a row
 * follows its spans.
 *
 * INVARIANT: rows[!current] is the row put last, which the next one is filtered against; it is the
 * only earlier row that is kept.
 */
#pragma once

#include "output/deflate/deflate.h"
#include "output/png/bytes.h"
#include "output/sinks/pixels.h"

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
typedef struct cs_png_run {
  int32_t end;    /* column after the last */
  uint64_t pixel; /* as bytes of the file, the first lowest */
} cs_png_run;

/* The runs cover the width, and neighbours differ. count 0: there is no row, for example above the
 * first one. */
typedef struct cs_png_runs {
  cs_png_run *runs;
  size_t count, capacity;
} cs_png_runs;

typedef struct cs_png_filter_runs {
  int32_t width;
  size_t pixel_size;
  cs_png_filter last;             /* the last filter that was chosen by its cost */
  int kept;                       /* for how many more rows it is used */
  uint8_t literal_costs[256];     /* about how much a difference costs, in eighths of a bit */
  cs_deflate_run *differences[2]; /* under two filters that are compared */
  size_t capacities[2];
} cs_png_filter_runs;

typedef struct cs_png_row {
  bool is_bytes;
  cs_png_runs runs; /* used unless is_bytes; without runs, this is the row above the first one */
  unsigned char *bytes; /* NULL until it is needed; zeros before and after (output/png/bytes.h) */
} cs_png_row;

typedef struct cs_png_rows {
  celspan_coding coding; /* 8 or 16 bit */
  int32_t width;
  size_t coded_size, pixel_size; /* bytes of a pixel: in coded form, and in the file */
  bool is_strip;   /* the first row's filter may not use the row above; false after begin */
  uint64_t stored; /* the bits of a coded pixel that are in the file */
  uint64_t common; /* the bits that are set in all coded pixels of the row */
  cs_png_row rows[2];
  int current; /* index of the next row */
  cs_png_filter_runs filter;
  cs_single_colours colours;
} cs_png_rows;

/* is_opaque: alpha is left out; then a pixel that is not opaque is refused. */
void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width, bool is_opaque);
/* Forgets the filters that were chosen for earlier rows, so that the choice for the next row does
 * not depend on them. */
void cs_png_rows_restart(cs_png_rows *rows);
CELSPAN_CHECKED celspan_status cs_png_rows_put(cs_png_rows *rows, celspan_context *context,
                                               const celspan_span *spans, size_t span_count,
                                               cs_deflate *deflate);
/* Sets a row that is not written: it is only the row above the next one. */
CELSPAN_CHECKED celspan_status cs_png_rows_set_above(cs_png_rows *rows, celspan_context *context,
                                                     const celspan_span *spans, size_t span_count);
void cs_png_rows_end(cs_png_rows *rows, celspan_context *context);
