/* The filters of PNG, chosen row by row, over runs and over bytes. */
#ifndef CS_OUTPUT_PNG_FILTER_H
#define CS_OUTPUT_PNG_FILTER_H

#include "output/png/bytes.h"
#include "output/png/rows.h"

void cs_png_costs_fill(cs_png_costs *costs);
/* Row and row above are those of `rows`, the row in hand as runs; when the one above is not, only
 * filters within the row are considered. */
CELSPAN_CHECKED celspan_status cs_png_filter_runs(cs_png_rows *rows, celspan_context *context,
                                                  const cs_png_row *row, const cs_png_row *above,
                                                  cs_deflate *deflate);
/* Both rows have zeros around them as png_wide.h says. size: bytes of a row. */
CELSPAN_CHECKED celspan_status cs_png_filter_bytes(cs_deflate *deflate, celspan_context *context,
                                                   size_t pixel_size, size_t size,
                                                   const unsigned char *row,
                                                   const unsigned char *above);

#endif
