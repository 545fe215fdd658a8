/* The filters of PNG over rows of bytes: the one whose differences cost least is put.
 *
 * INVARIANT: rows have zeros around them, as output/png/bytes.h draws.
 */
#ifndef CS_OUTPUT_PNG_FILTER_BYTES_H
#define CS_OUTPUT_PNG_FILTER_BYTES_H

#include "deflate/deflate.h"
#include "output/png/bytes.h"

/* most: the last filter that is tried; None and Sub come first, which do not look at the row above.
 * size: bytes of the row. */
CELSPAN_CHECKED celspan_status cs_png_filter_bytes_put(cs_deflate *deflate,
                                                       celspan_context *context, cs_png_filter most,
                                                       size_t pixel_size, size_t size,
                                                       const unsigned char *row,
                                                       const unsigned char *above);

#endif
