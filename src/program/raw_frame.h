/* Frames on standard output: rows of coded pixels, without a header. */
#pragma once

#include "celspan/celspan.h"

celspan_status cs_raw_frame_print(celspan_context *context, const celspan_frame_desc *frame,
                                  const celspan_coding *coding);
