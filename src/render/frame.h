/* A frame ready to be scanned: its description checked, every exposure compiled; and a lane, which
 * is what one worker needs to make its rows.
 *
 * Invariant: a frame does not change once made; lanes share it. A row of a lane depends on the
 * frame and the row's number alone.
 */
#ifndef CS_RENDER_FRAME_H
#define CS_RENDER_FRAME_H

#include "row/row.h"

typedef struct cs_frame {
  cs_plan *plans; /* one an exposure of weight > 0 */
  float *weights;
  size_t count, capacity;
  int32_t width, height; /* of the whole frame */
  int32_t crop_x, crop_y, crop_width, crop_height;
  int workers; /* at least 1 */
  int strip_height;
  bool takes_codes; /* rows may hold codes: for the sink they go to */
} cs_frame;

/* Errors: BAD_ARGUMENT naming the field; those of cs_compile. */
CELSPAN_CHECKED celspan_status cs_frame_create(celspan_context *context,
                                               const celspan_frame_desc *desc, cs_frame *out);
void cs_frame_free(cs_frame *frame, cs_memory *memory);
/* Threads for a number that is asked for; 0 or less: one a processor. */
int cs_frame_workers(int wanted);

typedef struct cs_row_worker {
  celspan_context context; /* a branch of the frame's */
  const cs_frame *frame;
  cs_row_maker *makers; /* one a shot */
  cs_row *rows;         /* one a shot */
  cs_row sum;
} cs_row_worker;

CELSPAN_CHECKED celspan_status cs_row_worker_init(cs_row_worker *row_worker,
                                                  celspan_context *context, const cs_frame *frame);
void cs_row_worker_finish(cs_row_worker *row_worker);
/* Row y of the crop. The row stays valid until the next call. Errors are in the lane's context. */
CELSPAN_CHECKED celspan_status cs_row_worker_row(cs_row_worker *row_worker, int32_t y,
                                                 const cs_row **out);
uint64_t cs_row_worker_evaluations(const cs_row_worker *row_worker);

#endif
