/* A row worker: the state of one thread that makes the rows of a frame.
 *
 *   exposure 0: plan --> row maker --> row --\
 *   exposure 1: plan --> row maker --> row ---+--> sum, by weight --> crop --> row of the frame
 *
 * With a single exposure of weight 1 its row is the row of the frame.
 *
 * A crowded frame (frame.h) is divided into panes, which the worker compiles one after the other:
 * rows are halved until few dashes are left, and a single row into columns.
 *
 *   +-------------------+     pane 1: rows with few dashes
 *   |         1         |     pane 2, 3: columns of one row, each with as many as allowed, whose
 *   +---------+---------+                spans are joined
 *   |    2    |    3    |
 *   +---------+---------+
 *
 * Invariant: a row depends on the frame and the number of the row alone, so it does not matter
 * which worker makes it. Whether a row is divided, and at which columns, depends on its own dashes
 * in the whole width of the frame: every crop has the same panes in it.
 */
#pragma once

#include "engine/map/frame_rows.h"
#include "engine/row/row.h"
#include "frames/render/held.h"

typedef struct cs_row_worker {
  celspan_context context; /* branched from the frame's context */
  const cs_frame *frame;
  CS_ARRAY(cs_row_maker, makers);     /* one for each exposure that has a plan */
  CS_ARRAY(cs_map_maker, map_makers); /* one for each exposure that is drawn from maps */
  CS_ARRAY(cs_row, rows);             /* one for each exposure */
  CS_ARRAY(cs_plan, plans);           /* the plans of the current pane of a crowded frame */
  cs_row sum;
  cs_held_copy held;
  /* of a crowded frame */
  cs_view pane;         /* the current pane; without rows where there is none */
  cs_row joined;        /* the row that was made of several panes */
  uint64_t evaluations; /* the evaluations of earlier panes */
} cs_row_worker;

CELSPAN_CHECKED celspan_status cs_row_worker_init(cs_row_worker *worker, celspan_context *context,
                                                  const cs_frame *frame);
void cs_row_worker_finish(cs_row_worker *worker);
/* Where the codes of the next row will be put, from its first column on; NULL: not known. */
void cs_row_worker_aim(cs_row_worker *worker, unsigned char *pixels);
/* Row y of the crop, clear where the crop reaches beyond the frame. The row stays valid until the
 * next call. The message of an error is in the worker's context. */
CELSPAN_CHECKED celspan_status cs_row_worker_row(cs_row_worker *worker, int32_t y,
                                                 const cs_row **out);
uint64_t cs_row_worker_evaluations(const cs_row_worker *worker);

/* ---- strips.c */

/* Feeds all rows of the frame to sink->row. desc: its progress function is called. Errors: those of
 * rows and of the sink; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_strips_render(celspan_context *context, const cs_frame *frame,
                                                const celspan_frame_desc *desc,
                                                const celspan_sink *sink,
                                                celspan_statistics *statistics);
