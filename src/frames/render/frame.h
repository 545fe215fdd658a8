/* A frame that is ready to be rendered: its description checked, and every exposure compiled.
 *
 *   celspan_frame_desc --check, compile--> cs_frame --row_worker.h, one a thread--> rows of spans
 *
 * Invariant: a frame does not change once it is made; the row workers share it.
 */
#pragma once

#include "engine/row/plan.h"

typedef struct cs_frame {
  cs_plan *plans; /* one for each exposure of weight > 0 */
  float *weights;
  size_t count, capacity;
  int32_t width, height; /* of the whole frame */
  int32_t crop_x, crop_y, crop_width, crop_height;
  int workers; /* at least 1 */
  int strip_height;
  bool takes_codes; /* rows may contain codes, because their sink takes them */
} cs_frame;

/* Whether the description can be read and rendered. Errors: BAD_ARGUMENT and LIMIT, naming the
 * field. */
CELSPAN_CHECKED celspan_status cs_frame_check(celspan_context *context,
                                              const celspan_frame_desc *desc);
/* Errors: those of checking; those of cs_compile. */
CELSPAN_CHECKED celspan_status cs_frame_create(celspan_context *context,
                                               const celspan_frame_desc *desc, cs_frame *out);
void cs_frame_free(cs_frame *frame, cs_memory *memory);
/* The number of threads for a number that is wanted; 0 or less: one per processor. */
int cs_frame_workers(int wanted);
