/* A picture as rows of a frame. A span file gives its own spans. Any other picture becomes a scene:
 * one image rectangle at the picture's size, lit white and sampled at pixel centres, so that every
 * pixel keeps its value.
 */
#ifndef CS_CLI_STILL_H
#define CS_CLI_STILL_H

#include "cli/request.h"
#include "cli/span_view.h"

typedef struct cs_still {
  celspan_picture_info info;
  celspan_exposure exposure; /* its rostrum is owned; NULL for a span file */
  cs_span_reader *spans;     /* owned; NULL for any other picture */
} cs_still;

/* OK, and *out new; or reported. */
cs_exit cs_still_open(celspan_context *context, const char *path, cs_still *out);
/* A still that is all zero may be closed too. */
void cs_still_close(cs_still *still);
/* The description of its frame under the options. OK, or reported. */
cs_exit cs_still_frame(const cs_still *still, const cs_request *request, celspan_frame_desc *out);

/* The frame into a file. frame: of cs_still_frame. */
CELSPAN_CHECKED celspan_status cs_still_write(celspan_context *context, const cs_still *still,
                                              const celspan_frame_desc *frame, const char *path,
                                              const celspan_file_desc *file);

/* The frame, or another size or crop of it, into a sink of the caller's. */
CELSPAN_CHECKED celspan_status cs_still_render(celspan_context *context, const cs_still *still,
                                               const celspan_frame_desc *frame,
                                               const celspan_sink *sink);

/* The frame row by row; one of the two is NULL. */
typedef struct cs_still_rows {
  celspan_rows *rendered;
  cs_span_view *view;
} cs_still_rows;
/* still: borrowed as long as the rows are. out: new. */
CELSPAN_CHECKED celspan_status cs_still_rows_create(celspan_context *context, const cs_still *still,
                                                    const celspan_frame_desc *frame,
                                                    cs_still_rows *out);
/* Rows that are all zero may be destroyed too. */
void cs_still_rows_destroy(cs_still_rows *rows);
/* y: row of the crop, from 0. Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_still_rows_get(cs_still_rows *rows, int32_t y,
                                                 const celspan_span **spans, size_t *span_count);

#endif
