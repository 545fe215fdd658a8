/* Strips: rows of a frame made together by a worker, delivered in order.
 *
 *   workers --rows, strip by strip--> strips --in order, by the calling thread--> sink
 *
 * A sink that takes shares (output/sinks/shares.h) gets the rows from the workers directly,
 * and the shares are then joined in order. The calling thread works too while it has nothing to
 * deliver.
 *
 * INVARIANT: the sink gets the same spans whatever the number of workers and the height of strips;
 * if rows fail, the failure of the topmost of them is reported.
 */
#pragma once

#include "frames/render/row_worker.h"

/* Feeds all rows of the frame to sink->row. desc: its progress function is called. Errors: those of
 * rows and of the sink; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_strips_render(celspan_context *context, const cs_frame *frame,
                                                const celspan_frame_desc *desc,
                                                const celspan_sink *sink,
                                                celspan_statistics *statistics);
