/* Spans to rows of coded pixels, four channels each, in the machine's byte order (little endian):
 *
 *   depth     bytes of a pixel
 *   8         R G B A                     straight or premultiplied, along a transfer curve
 *   16        RR GG BB AA
 *   half      RR GG BB AA                 IEEE 754 binary16
 *   float     RRRR GGGG BBBB AAAA         IEEE 754 binary32
 *
 * INVARIANT: a pixel's bytes depend on its colour and the coding alone; not on the spans around it,
 * the length of its run, the address of the row or the set of instructions.
 */
#ifndef CS_OUTPUT_PIXELS_H
#define CS_OUTPUT_PIXELS_H

#include "base/context.h"

/* Whether the numbers of a coding that a caller gave are values of their enumerations; NULL is a
 * coding. Errors: BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_pixels_check(celspan_context *context,
                                               const celspan_coding *coding);
/* The coding with every default filled in, for integers and floats alike. 8_DITHER becomes 8: the
 * rest is done by output/dither.h. */
celspan_coding cs_pixels_resolve(const celspan_coding *coding, celspan_depth default_depth);

/* Writes one row of pixels: the spans cover [0, width) without gap. A single span is coded once and
 * filled. Codes of arrays are copied: of 8 bits, and in this coding. coding: resolved. Threads: any. */
void cs_pixels_row(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                   void *row);
/* Whether array spans may hold codes, pixels coded already, in this coding. coding: resolved. */
bool cs_pixels_takes_codes(const celspan_coding *coding);
/* Columns [x, x + count) of a span, as a span from column 0. */
celspan_span cs_pixels_crop(const celspan_span *span, int32_t x, int32_t count);
/* One colour, linear premultiplied, as the numbers that integers are rounded from: 1 is the largest.
 */
void cs_pixels_encode(const celspan_coding *coding, const float rgba[4], float coded[4]);
/* One colour, linear premultiplied, to one coded pixel. */
void cs_pixels_code(const celspan_coding *coding, const float rgba[4], void *pixel);

#endif
