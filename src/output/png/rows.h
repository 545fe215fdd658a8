/* Rows of spans to filtered rows of PNG bytes (PNG 3rd edition, 7 and 9), into a deflate stream.
 *
 *                     +--> runs ---filter_runs--+
 *   spans --code------+        (only if needed) +--> deflate
 *                     +--> bytes --filter_bytes-+
 *
 *   pixels    coded (output/pixels.h)     in the file
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
#ifndef CS_OUTPUT_PNG_ROWS_H
#define CS_OUTPUT_PNG_ROWS_H

#include "output/png/filter_runs.h"
#include "output/single_colours.h"

typedef struct cs_png_row {
  bool is_bytes;
  cs_png_runs runs;     /* unless is_bytes; none: the row above the first one */
  unsigned char *bytes; /* NULL until first needed; zeros before and after (output/png/bytes.h) */
} cs_png_row;

typedef struct cs_png_rows {
  celspan_coding coding; /* 8 or 16 bit */
  int32_t width;
  size_t coded_size, pixel_size; /* bytes of a pixel, as coded and as in the file */
  bool is_strip;                 /* the first row's filter may not look up; false after begin */
  uint64_t stored;               /* the bits of a coded pixel that are in the file */
  uint64_t common;               /* the bits that are set in all coded pixels of the row */
  cs_png_row rows[2];
  int current; /* the row that comes next */
  cs_png_filter_runs filter;
  cs_single_colours colours;
} cs_png_rows;

/* is_opaque: alpha is left out; a pixel that is not opaque is then refused. */
void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width, bool is_opaque);
/* Forgets the filters chosen for earlier rows, so that the next row's does not depend on them. */
void cs_png_rows_restart(cs_png_rows *rows);
CELSPAN_CHECKED celspan_status cs_png_rows_put(cs_png_rows *rows, celspan_context *context,
                                               const celspan_span *spans, size_t span_count,
                                               cs_deflate *deflate);
/* A row that is not put: it only serves as the one above the next. */
CELSPAN_CHECKED celspan_status cs_png_rows_set_above(cs_png_rows *rows, celspan_context *context,
                                                     const celspan_span *spans, size_t span_count);
void cs_png_rows_end(cs_png_rows *rows, celspan_context *context);

#endif
