/* A picture as rows of a frame. The rows of a span file are its own spans; the rows of a plane are
 * drawn. Any other picture becomes a scene: one image rectangle of the picture's size, lit white
 * and sampled at pixel centres, so that every pixel keeps its value.
 */
#pragma once

#include "celspan/plane.h"
#include "writers/plane/plane.h"
#include "writers/still/span_reader.h"

typedef struct cs_still {
  celspan_picture_info info;
  celspan_exposure exposure; /* the rostrum is owned; NULL for a span file or a plane */
  celspan_space space;       /* the space of the frame */
  cs_span_reader *spans;     /* owned; NULL for any other picture */
  celspan_plane *plane;      /* likewise; its info has the size in film units, rounded */
} cs_still;

/* frame: of a film of planes, from 1; 0: the first one, or the picture. out: new. Errors: those of
 * reading a picture; BAD_ARGUMENT: there is no such frame. */
CELSPAN_CHECKED celspan_status cs_still_open(celspan_context *context, const char *path,
                                             int32_t frame, cs_still *out);
/* still: may be all zero. */
void cs_still_close(cs_still *still);
/* Sets the exposures and the space of a frame, whose film has the size of the picture. */
void cs_still_expose(const cs_still *still, celspan_frame_desc *frame);

/* Writes the frame to a file. */
CELSPAN_CHECKED celspan_status cs_still_write(celspan_context *context, const cs_still *still,
                                              const celspan_frame_desc *frame, const char *path,
                                              const celspan_file_desc *file);

/* Renders the frame, or another size or crop of it, into a sink of the caller. */
CELSPAN_CHECKED celspan_status cs_still_render(celspan_context *context, const cs_still *still,
                                               const celspan_frame_desc *frame,
                                               const celspan_sink *sink);

/* The rows of the frame; one of the fields is not NULL. */
typedef struct cs_still_rows {
  celspan_rows *rendered;
  cs_span_view *view;
  cs_plane_rows *drawn;
} cs_still_rows;
/* still: must live as long as the rows. out: new. */
CELSPAN_CHECKED celspan_status cs_still_rows_create(celspan_context *context, const cs_still *still,
                                                    const celspan_frame_desc *frame,
                                                    cs_still_rows *out);
/* rows: may be all zero. */
void cs_still_rows_destroy(cs_still_rows *rows);
/* y: row of the crop, from 0. Valid until the next call. */
CELSPAN_CHECKED celspan_status cs_still_rows_get(cs_still_rows *rows, int32_t y,
                                                 const celspan_span **spans, size_t *span_count);
