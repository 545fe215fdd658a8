/* A thread that writes the samples of a sound to an encoder, as they are wanted.
 *
 *   cs_sound_stream --read--> feeder --pipe--> encoder, which may want only the first of them
 *
 * INVARIANT: the descriptor is closed when the thread has ended, and the samples when the feeder is
 * finished.
 */
#pragma once

#include <stdatomic.h>

#include "base/thread_pool.h"
#include "frames/video/sound_stream.h"

typedef struct cs_feeder {
  celspan_context branch;  /* of the thread */
  cs_sound_stream samples; /* owned */
  int descriptor;
  cs_thread thread;
  atomic_int status; /* a celspan_status; its sentence is in the branch */
  bool is_open;
} cs_feeder;

/* Starts to write the samples to the descriptor, which it closes in any case. *samples: moved to
 * the feeder. out: must not move while it is open. Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_feeder_open(cs_feeder *out, celspan_context *context,
                                              cs_sound_stream *samples, int descriptor);
/* Whether the samples cannot be read or written. */
bool cs_feeder_has_failed(const cs_feeder *feeder);
/* Ends the thread after the encoder has ended, and closes the samples; does nothing if it is not
 * open. */
void cs_feeder_end(cs_feeder *feeder);
/* The outcome of a feeder that has ended. Errors: those of the samples; OUTPUT. */
CELSPAN_CHECKED celspan_status cs_feeder_outcome(const cs_feeder *feeder, celspan_context *context);
