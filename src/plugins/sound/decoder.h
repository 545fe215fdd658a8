/* A sound that ffmpeg decodes in a worker (plugins/isolate/sound_worker.h), as a stream of samples.
 *
 * INVARIANT: everything from the worker is checked, because a malicious sound may control the
 * worker: the form of the samples has bounds, and infinite samples become 0.
 */
#pragma once

#include "frames/video/sound_stream.h"

typedef struct cs_decoder_desc {
  const char *path;       /* for messages */
  const char *kind;       /* the name of its format in ffmpeg */
  int descriptor;         /* of the file; borrowed until it is open */
  int32_t rate, channels; /* the wanted ones; 0: those of the file */
  double speed;           /* 1: unchanged */
} cs_decoder_desc;

/* Errors: those of cs_sound_open. */
CELSPAN_CHECKED celspan_status cs_decoder_open(celspan_context *context,
                                               const cs_decoder_desc *desc, cs_sound_stream *out);
