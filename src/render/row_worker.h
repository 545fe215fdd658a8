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
#ifndef CS_RENDER_ROW_WORKER_H
#define CS_RENDER_ROW_WORKER_H

#include "render/frame.h"
#include "row/row.h"

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

#endif
