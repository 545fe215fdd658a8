/* Rows of spans to filtered rows of PNG bytes (PNG 3rd edition, 9), into a deflate stream.
 *
 * A row is held as runs of equal pixels, or, when an eighth of it or more lies in pictures and
 * gradients, as plain bytes. Runs are filtered without being laid out, so the cost of a row follows
 * its spans. Only the row before is kept.
 */
#ifndef CS_OUTPUT_PNG_ROWS_H
#define CS_OUTPUT_PNG_ROWS_H

#include "deflate/deflate.h"
#include "output/colours.h"

typedef struct cs_png_run {
  int32_t end;    /* column after the last */
  uint64_t pixel; /* as bytes of the file, lowest first */
} cs_png_run;

typedef struct cs_png_row {
  bool is_bytes;
  cs_png_run *runs; /* neighbours differ */
  size_t run_count, run_capacity;
  unsigned char *bytes; /* NULL until first needed; zeros before and after, see png_wide.h */
} cs_png_row;

/* What a byte of a difference costs as a literal, about, in eighths of a bit. */
typedef struct cs_png_costs {
  uint8_t literal[256];
} cs_png_costs;

typedef struct cs_png_rows {
  celspan_coding coding; /* 8 or 16 bit */
  int32_t width;
  size_t coded_size, pixel_size; /* bytes of a pixel, RGBA as coded and as in the file */
  uint64_t stored;               /* the bits of a coded pixel that are in the file */
  uint64_t common;               /* the bits that all coded pixels of the row in hand have */
  cs_png_row rows[2];            /* the one in hand and the one before, in turn */
  int current;
  int filter, kept; /* of rows of runs: the last choice, and for how many more it is kept */
  cs_png_costs costs;
  cs_deflate_run *residues[2]; /* of two filters, to be compared */
  size_t residue_capacities[2];
  cs_colours colours;
} cs_png_rows;

/* is_opaque: alpha is left out; a pixel that is not opaque is then refused. */
void cs_png_rows_begin(cs_png_rows *rows, celspan_coding coding, int32_t width, bool is_opaque);
/* What was chosen for earlier rows is forgotten, so that a strip does not depend on where the rows
 * before it went. */
void cs_png_rows_restart(cs_png_rows *rows);
CELSPAN_CHECKED celspan_status cs_png_rows_put(cs_png_rows *rows, celspan_context *context,
                                               const celspan_span *spans, size_t span_count,
                                               cs_deflate *deflate);
/* The row is only what the next one stands under. */
CELSPAN_CHECKED celspan_status cs_png_rows_pass(cs_png_rows *rows, celspan_context *context,
                                                const celspan_span *spans, size_t span_count);
void cs_png_rows_end(cs_png_rows *rows, celspan_context *context);

#endif
