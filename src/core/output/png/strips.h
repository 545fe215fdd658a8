/* Rows of spans to the image data of a PNG: one zlib stream, made strip by strip, side by side.
 *
 *   rows --copied--> strip --filter, deflate (any thread)--> part --in order--> write
 *
 * Where strips begin depends on the picture's size alone, and a strip is compressed from its own
 * rows and the one above them: the bytes are the same however many threads there are. With one
 * thread nothing is copied.
 */
#pragma once

#include "output/png/rows.h"
#include "output/sinks/shares.h"

typedef struct cs_png_strips cs_png_strips;

typedef struct cs_png_picture {
  celspan_coding coding; /* resolved, 8 or 16 bit */
  bool is_opaque;
  bool is_strip; /* there are rows above row 0, but its filter does not use them */
  int32_t width, height;
  int workers; /* 0: one per processor */
} cs_png_picture;

/* write: called with a part at a time, by the thread that calls these functions. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_png_strips_create(celspan_context *context,
                                                    const cs_png_picture *picture,
                                                    cs_deflate_write write, void *user,
                                                    cs_png_strips **out);
/* The next row. Errors: NO_MEMORY; BAD_ARGUMENT if it is not opaque although the description says
 * so; the errors of write. */
CELSPAN_CHECKED celspan_status cs_png_strips_row(cs_png_strips *strips, celspan_context *context,
                                                 const celspan_span *spans, size_t span_count);
/* Called after the last row: writes the rest. */
CELSPAN_CHECKED celspan_status cs_png_strips_finish(cs_png_strips *strips,
                                                    celspan_context *context);
/* How several threads fill strips from rows that they make themselves; used instead of
 * cs_png_strips_row. */
cs_shares cs_png_strips_shares(cs_png_strips *strips);
/* May be called at any time; NULL is ignored. */
void cs_png_strips_destroy(cs_png_strips *strips, celspan_context *context);
