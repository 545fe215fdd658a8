/* Spans to rows of coded pixels. */
#ifndef CS_OUTPUT_PIXELS_H
#define CS_OUTPUT_PIXELS_H

#include "celspan/celspan.h"

/* The coding with every default filled in, for integers and floats alike. */
celspan_coding cs_pixels_resolve(const celspan_coding *coding, celspan_depth default_depth);

/* Writes one row of RGBA pixels: the spans cover [0, width) without gap. Fills long single spans
 * by one coded pixel. coding: resolved. Deterministic. Threads: any. */
void cs_pixels_row(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                   void *row);
/* Whether a row of that coding is content with spans that hold codes. coding: resolved. */
bool cs_pixels_takes_codes(const celspan_coding *coding);
/* [x, x + count) of a span, as a span from column 0. */
celspan_span cs_pixels_part(const celspan_span *span, int32_t x, int32_t count);
/* One colour, linear premultiplied, to one coded pixel. */
void cs_pixels_code(const celspan_coding *coding, const float rgba[4], void *pixel);

#endif
