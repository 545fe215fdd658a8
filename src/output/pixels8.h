/* Rows of 8 bits, sRGB, straight alpha, which is how nearly every frame is written. */
#ifndef CS_OUTPUT_PIXELS8_H
#define CS_OUTPUT_PIXELS8_H

#include "base/wide.h"
#include "celspan/celspan.h"

/* The spans, one at least, cover [0, width) without gap. */
CS_WIDE_DECLARE(void, cs_pixels8_row,
                (const celspan_span *spans, size_t count, unsigned char *row));

#endif
