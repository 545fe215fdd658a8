/* Frames of one size whose rows are made together, each frame by one thread at a time:
 *
 *   frame 0  --rows y .. y + n--> pixels \   row y       frame 0 | frame 1 | frame 2 | others
 *   frame 1  --rows y .. y + n--> pixels  +- row y + 1   frame 0 | frame 1 | frame 2 | others
 *   frame 2  --rows y .. y + n--> pixels /   <------------- stride ------------------------->
 *
 * INVARIANT: the pixels do not depend on the number of threads; if frames fail, the failure of the
 * first of them is reported.
 */
#pragma once

#include "celspan/celspan.h"
#include "inside/context.h"

#define CS_SOURCES_PORTION ((size_t)8 << 20) /* bytes of rows that are made together */

/* Gradient spans are this close to their colours. So frames in which gradients begin at different
 * columns agree: a frame and its layers, and the steps of its mattes. */
#define CS_SOURCES_TOLERANCE 0x1p-20

typedef struct cs_frame_source {
  celspan_context context;
  celspan_rows *rows;
  celspan_status status;
} cs_frame_source;

typedef struct cs_sources {
  celspan_context *context;
  celspan_coding coding; /* resolved */
  size_t row;            /* bytes of a row of one frame */
  cs_frame_source *sources;
  size_t count;
  int workers;
} cs_sources;

/* coding: resolved. count: of frames, which must then be opened; 0 is allowed. Must be finished,
 * also after an error. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sources_begin(celspan_context *context,
                                                const celspan_coding *coding, int32_t width,
                                                size_t count, cs_sources *out);
CELSPAN_CHECKED celspan_status cs_sources_open(cs_sources *sources, size_t index,
                                               const celspan_frame_desc *desc);
/* Rows y .. y + lines - 1 of all frames. Errors: those of rendering. */
CELSPAN_CHECKED celspan_status cs_sources_make(cs_sources *sources, int32_t y, int32_t lines,
                                               unsigned char *pixels, size_t stride);
void cs_sources_finish(cs_sources *sources);
