/* A stream of samples: a decoded sound.
 *
 *   sound file --plugins/sound/sound.h--> cs_sound_stream --encoder.h--> the encoder of a video
 *
 * A moment has a sample for each channel, which is a float from -1 to 1; louder ones may be beyond.
 *
 * INVARIANT: samples are read in their order by one thread at a time. All are finite.
 */
#pragma once

#include "inside/context.h"

enum {
  CS_SOUND_STREAM_CHANNELS = 64,
  CS_SOUND_STREAM_RATE = 1 << 20 /* moments in a second, at most */
};

typedef struct cs_sound_stream {
  void *user;       /* owned; NULL: there is no sound */
  int32_t rate;     /* moments in a second */
  int32_t channels; /* the channels of a moment */
  uint32_t places;  /* where channels are, numbered as in WAV files; 0: the usual */
  /* Reads up to `count` moments. *got: fewer only at the end, and after `stop`. context: that of
   * the calling thread. Errors: INPUT, LIMIT, NO_MEMORY, CANCELLED. */
  celspan_status (*read)(void *user, celspan_context *context, float *out, size_t count,
                         size_t *got);
  void (*stop)(void *user); /* ends a read that waits; any thread */
  void (*close)(void *user);
} cs_sound_stream;

static inline void cs_sound_stream_close(cs_sound_stream *samples) {
  if (samples->user)
    samples->close(samples->user);
  samples->user = NULL;
}
