/* Span files as rows of spans: linear light, premultiplied, as renderers make them.
 *
 * Only requested rows are read. Memory: one row.
 */
#pragma once

#include <spanfile.h>

#include "celspan/celspan.h"

typedef struct cs_span_reader cs_span_reader;

/* Whether the file can be read and begins like a span file. */
bool cs_span_reader_accepts(const char *path);

/* path: copied. out: new. Errors: INPUT with the byte and the reason, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_span_reader_open(celspan_context *context, const char *path,
                                                   cs_span_reader **out);
void cs_span_reader_close(cs_span_reader *file);

spanfile_info cs_span_reader_info(const cs_span_reader *file);
uint64_t cs_span_reader_bytes(const cs_span_reader *file);

/* The columns [x0, x1) of row y, moved left by x0: sorted, without gaps. Gradients come as arrays.
 * Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_span_reader_row(cs_span_reader *file, int32_t y, int32_t x0,
                                                  int32_t x1, const celspan_span **spans,
                                                  size_t *span_count);
/* Reads the whole file and counts its elements. */
CELSPAN_CHECKED celspan_status cs_span_reader_check(cs_span_reader *file, spanfile_counts *counts);

/* ---- span_view.c */

typedef struct cs_span_view cs_span_view;

/* file: must live as long as the view. frame: its sizes and crop. out: new. */
CELSPAN_CHECKED celspan_status cs_span_view_create(celspan_context *context, cs_span_reader *file,
                                                   const celspan_frame_desc *frame,
                                                   cs_span_view **out);
void cs_span_view_destroy(cs_span_view *view);
/* y: row of the crop, from 0. Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_span_view_row(cs_span_view *view, int32_t y,
                                                const celspan_span **spans, size_t *span_count);
