/* Frames on standard output: rows of coded pixels, without a header. */
#pragma once

#include "celspan/celspan.h"
#include "inside/films.h"

/* Makes a frame, and writes its rows while they are made. Errors: those of rendering; OUTPUT. */
celspan_status cs_raw_frame_print(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding);
/* Opens slots for frames like this one, if workers can make several of them beside each other;
 * otherwise there are none. *slots: new; must be closed. Errors: NO_MEMORY. */
celspan_status cs_raw_frame_slots(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding, cs_slots *slots);
/* Makes a frame in a slot. Any thread, with its context. Errors: those of rendering. */
celspan_status cs_raw_frame_make(celspan_context *context, const celspan_frame_desc *frame,
                                 const celspan_coding *coding, const cs_slots *slots, size_t slot);
/* Writes the frame in a slot. Errors: OUTPUT. */
celspan_status cs_raw_frame_give(celspan_context *context, const cs_slots *slots, size_t slot);
