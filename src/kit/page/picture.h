/* A frame as the bytes of a PNG: those of the file that the program writes. */
#pragma once

#include "celspan/celspan.h"

/* *bytes: NULL, or those of another picture, which are freed; for free() in any case. title: NULL:
 * none. Errors: any; OUTPUT when memory is short. */
CELSPAN_CHECKED celspan_status cs_picture_png(celspan_context *context,
                                              const celspan_frame_desc *frame, const char *title,
                                              unsigned char **bytes, size_t *size);
