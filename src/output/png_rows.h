/* Rows of spans to filtered rows of PNG bytes (PNG 3rd edition, 9), into a deflate stream.
 *
 * A row is held as runs of equal pixels, or, when an eighth of it or more lies in pictures and
 * gradients, as plain bytes. Runs are filtered without being laid out, so the cost of a row follows
 * its spans. Only the row before is kept.
 */
#ifndef CS_OUTPUT_PNG_ROWS_H
#define CS_OUTPUT_PNG_ROWS_H

#include "output/deflate.h"

enum { CS_PNG_BLOCK = 16 };

typedef struct cs_png_run {
  int32_t end;    /* column after the last */
  uint64_t pixel; /* as bytes of the file, lowest first */
} cs_png_run;

typedef struct cs_png_row {
  bool is_bytes;
  cs_png_run *runs; /* neighbours differ */
  size_t run_count, run_capacity;
  unsigned char *bytes; /* NULL until first needed; zeros before and after, see png_filter.h */
} cs_png_row;

/* Pixels met lately as None, Sub and Up would write them: what they will cost to write again. */
enum { CS_PNG_SEEN_BITS = 10 };
typedef struct cs_png_seen {
  uint32_t tags[3][1 << CS_PNG_SEEN_BITS];
} cs_png_seen;

typedef struct cs_png_rows {
  celspan_coding coding; /* 8 or 16 bit */
  int32_t width;
  size_t pixel_size;
  cs_png_row rows[2]; /* the one in hand and the one before, in turn */
  int current;
  cs_png_seen seen;
} cs_png_rows;

void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width);
CELSPAN_CHECKED celspan_status cs_png_rows_put(cs_png_rows *rows, celspan_context *context,
                                               const celspan_span *spans, size_t span_count,
                                               cs_deflate *deflate);
void cs_png_rows_end(cs_png_rows *rows, celspan_context *context);

#endif
