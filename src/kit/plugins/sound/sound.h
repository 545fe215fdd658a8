/* The sound files of films: the one place where they are opened and decoded.
 *
 *   file --> its format --plugins/isolate/media_worker.h--> decoder.c --> cs_sound_stream
 *
 * INVARIANT: a sound is opened here, and nothing else opens it by its name. Pipes, devices and
 * folders are refused at once. A decoder that sends no more samples is ended after the time limit
 * of pictures, and ends with this program in any case.
 */
#pragma once

#include "common/sound_stream.h"

typedef struct cs_sound_request {
  const char *path;  /* the path of a file, or an address that contains it (common/address.h) */
  const char *tried; /* other paths that do not exist either, for messages; NULL: none */
  int32_t rate, channels; /* the wanted ones; 0: as the file has them */
  double speed;           /* 2: twice as fast, without changing the pitch; 0 and 1: unchanged */
} cs_sound_request;

/* What messages call a sound: its path, or the beginning of its address. */
const char *cs_sound_name(const char *path);
/* Checks that the file can be opened and has one of the formats. tried: other paths that do not
 * exist either, or NULL. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_sound_find(celspan_context *context, const char *path,
                                             const char *tried);
/* Starts to decode the sound, and waits for its first samples. Errors: INPUT, with the message of
 * ffmpeg; LIMIT; OUTPUT, if there is no ffmpeg; NO_MEMORY; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_sound_open(celspan_context *context,
                                             const cs_sound_request *request, cs_sound_stream *out);

enum { CS_SOUND_HOURS = 24, CS_SOUND_HEARD_RATE = 48000 /* moments in a second */ };

/* Takes `count` moments of a stream, one after another. */
typedef celspan_status cs_sound_take(void *user, celspan_context *context, const float *moments,
                                     size_t count);

/* Gives all moments of a stream of CS_SOUND_HEARD_RATE to `take`, in their order. name: for
 * messages. Errors: those of the stream and of `take`; NO_MEMORY; LIMIT beyond CS_SOUND_HOURS. */
CELSPAN_CHECKED celspan_status cs_sound_each(celspan_context *context,
                                             const cs_sound_stream *samples, const char *name,
                                             cs_sound_take *take, void *user);

/* ---- decoder.c */

typedef struct cs_decoder_desc {
  const char *path;       /* for messages */
  const char *kind;       /* the name of its format in ffmpeg */
  int descriptor;         /* the descriptor of the file; borrowed until it is open */
  int32_t rate, channels; /* the wanted ones; 0: as the file has them */
  double speed;           /* 1: unchanged */
} cs_decoder_desc;

/* Errors: those of cs_sound_open. */
CELSPAN_CHECKED celspan_status cs_decoder_open(celspan_context *context,
                                               const cs_decoder_desc *desc, cs_sound_stream *out);
