/* A span file seen at a size and through a crop, row by row.
 *
 * At its own size rows come as they are. Each axis else by itself: where the picture shrinks, the
 * mean over what a pixel covers, taken from the spans, in time that follows them and not the
 * pixels; where it grows, linear between the nearest two, in linear light. Only the rows that the
 * crop covers are read. Memory: a few rows.
 */
#ifndef CS_CLI_SPAN_VIEW_H
#define CS_CLI_SPAN_VIEW_H

#include "cli/span_reader.h"

typedef struct cs_span_view cs_span_view;

/* file: borrowed as long as the view is. frame: its sizes and crop. out: new. */
CELSPAN_CHECKED celspan_status cs_span_view_create(celspan_context *context, cs_span_reader *file,
                                                   const celspan_frame_desc *frame,
                                                   cs_span_view **out);
void cs_span_view_destroy(cs_span_view *view);
/* y: row of the crop, from 0. Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_span_view_row(cs_span_view *view, int32_t y,
                                                const celspan_span **spans, size_t *span_count);

#endif
