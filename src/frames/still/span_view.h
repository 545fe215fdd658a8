/* A span file at another size and through a crop, row by row.
 *
 *   file    |---|---|---|---|---|---|     6 columns
 *   frame   |-----|-----|-----|-----|     4 columns: each is the mean of 1.5 columns of the file
 *
 *   file    |-------|-------|-------|     3 columns
 *   frame   |---|---|---|---|---|---|     6 columns: each lies between two middles of the file's
 *
 * At the file's own size rows are returned as they are. Otherwise each axis is resampled by itself,
 * in linear light. Where the picture shrinks, a pixel is the mean over the area that it covers,
 * computed from the spans in time proportional to their number; where it grows, it is interpolated
 * linearly between the nearest two. Only the rows that the crop covers are read. Memory: a few
 * rows.
 */
#pragma once

#include "frames/still/span_reader.h"

typedef struct cs_span_view cs_span_view;

/* file: must live as long as the view. frame: its sizes and crop. out: new. */
CELSPAN_CHECKED celspan_status cs_span_view_create(celspan_context *context, cs_span_reader *file,
                                                   const celspan_frame_desc *frame,
                                                   cs_span_view **out);
void cs_span_view_destroy(cs_span_view *view);
/* y: row of the crop, from 0. Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_span_view_row(cs_span_view *view, int32_t y,
                                                const celspan_span **spans, size_t *span_count);
