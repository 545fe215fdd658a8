/* A coder says how spans become whole rows of pixels.
 *
 *   spans --coder--> a row of pixels, as one span of codes --> the sink behind
 *
 * INVARIANT: the bytes of a row depend on its colours, its place in the whole frame and the coder
 * alone. So a row that was coded before may come instead of its spans, as one span of codes.
 */
#pragma once

#include "base/context.h"
#include "celspan/celspan.h"

typedef struct cs_coder {
  celspan_coding coding; /* resolved */
  int32_t x, y;          /* the place of the first pixel in the whole frame */
  bool dithers;
} cs_coder;

/* The coder of what a caller asks for, which may be NULL. x, y: as in cs_coder. */
cs_coder cs_coder_of(const celspan_coding *asked, int32_t x, int32_t y);
/* Codes the spans of row y, which cover [0, width) without gap. Any thread. */
void cs_coder_row(const cs_coder *coder, int32_t y, const celspan_span *spans, size_t span_count,
                  void *row);

/* Puts a sink in front of *sink that codes each row and gives it on as one span of codes. On
 * failure *sink is discarded. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_coder_sink(celspan_context *context, const cs_coder *coder,
                                             celspan_sink *sink);
/* Where that sink codes its next row, unless the row was coded before; NULL: in memory of its own.
 * The sink behind may call this from its `begin` and its `row`. */
void cs_coder_aim(const celspan_sink *sink, unsigned char *row);
/* As cs_coder_sink if the requested coding has the depth 8_DITHER; otherwise does nothing. coding:
 * resolved. x, y: as in cs_coder. */
CELSPAN_CHECKED celspan_status cs_coder_dither(celspan_context *context,
                                               const celspan_coding *asked,
                                               const celspan_coding *coding, int32_t x, int32_t y,
                                               celspan_sink *sink);
/* How the sink codes whole rows, if it does nothing else with their spans. NULL: it needs the
 * spans, or its pixels are floats, which are larger than the spans that they come from, or its
 * coding converts colours in a way that cannot be compared. */
const cs_coder *cs_sink_coder(const celspan_sink *sink);
