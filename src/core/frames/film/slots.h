/* The slots of a stream of frames: buffers, so that several workers make whole frames ahead of the
 * one that is given on next.
 *
 *   a frame --any worker--> its slot --in the order of the frames--> whoever reads the stream
 *
 * INVARIANT: the bytes of slots are counted as those of caches are, not as memory of the script.
 */
#pragma once

#include "base/context.h"

typedef struct cs_slots {
  unsigned char **frames; /* buffers of the same size, which may be exchanged for others; owned */
  size_t count;
  size_t frame_size; /* bytes */
} cs_slots;

/* How many slots the workers can use, of those for which the caches leave room; at least 1.
 * workers: as in celspan_frame_desc. */
size_t cs_slots_count(celspan_context *context, size_t frame_size, int workers);
/* out: new; must be closed, whatever this returns. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_slots_open(cs_slots *out, celspan_context *context, size_t count,
                                             size_t frame_size);
/* Slots that are all zero, or closed already, may be closed too. */
void cs_slots_close(cs_slots *slots, celspan_context *context);
