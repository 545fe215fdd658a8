/* Strips: rows of a frame made together by a worker, delivered in order.
 *
 *   workers --rows, strip by strip--> strips --in order, by the calling thread--> sink
 *
 * A sink that takes shares (output/sinks/shares.h) gets the rows from the workers directly,
 * and the shares are then joined in order. The calling thread works too while it has nothing to
 * deliver.
 *
 * INVARIANT: the sink gets the same spans whatever the number of workers and the height of strips;
 * the failure reported is that of the topmost row that failed.
 */
#pragma once

#include "engine/row/row.h"
#include "frames/render/frame.h"

/* A row worker: what one thread needs to make the rows of a frame.
 *
 *   exposure 0: plan --> row maker --> row --\
 *   exposure 1: plan --> row maker --> row ---+--> sum, by weight --> crop --> row of the frame
 *
 * With a single exposure of weight 1 its row is the row of the frame.
 *
 * Invariant: a row depends on the frame and the number of the row alone, so it does not matter
 * which worker makes it.
 */

typedef struct cs_row_worker {
  celspan_context context; /* a branch of the frame's */
  const cs_frame *frame;
  cs_row_maker *makers; /* one for each plan */
  cs_row *rows;         /* one for each plan */
  cs_row sum;
} cs_row_worker;

CELSPAN_CHECKED celspan_status cs_row_worker_init(cs_row_worker *worker, celspan_context *context,
                                                  const cs_frame *frame);
void cs_row_worker_finish(cs_row_worker *worker);
/* Row y of the crop. The row stays valid until the next call. The message of an error is
 * in the worker's context. */
CELSPAN_CHECKED celspan_status cs_row_worker_row(cs_row_worker *worker, int32_t y,
                                                 const cs_row **out);
uint64_t cs_row_worker_evaluations(const cs_row_worker *worker);

/* Feeds all rows of the frame to sink->row. desc: for its progress function.
 * Errors: those of rows and of the sink; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_strips_render(celspan_context *context, const cs_frame *frame,
                                                const celspan_frame_desc *desc,
                                                const celspan_sink *sink,
                                                celspan_statistics *statistics);
