/* The filters of PNG, chosen row by row, over runs and over bytes. */
#ifndef CS_OUTPUT_PNG_FILTER_H
#define CS_OUTPUT_PNG_FILTER_H

#include "output/png_rows.h"

void cs_png_costs_fill(cs_png_costs *costs);
/* above: may be bytes or empty, then only filters within the row are considered. */
CELSPAN_CHECKED celspan_status cs_png_filter_runs(cs_deflate *deflate, celspan_context *context,
                                                  const cs_png_costs *costs, size_t pixel_size,
                                                  const cs_png_row *row, const cs_png_row *above);
/* Both rows have a pixel of zeros before their first and CS_PNG_BLOCK zeros after their last. size:
 * bytes of a row. */
CELSPAN_CHECKED celspan_status cs_png_filter_bytes(cs_deflate *deflate, celspan_context *context,
                                                   size_t pixel_size, size_t size,
                                                   const unsigned char *row,
                                                   const unsigned char *above);

#endif
