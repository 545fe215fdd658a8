/* A queue of frames for an encoder, which runs while the next frames are made.
 *
 *   give: pixels --> a free place --> queue --thread--> the encoder's standard input
 *                           repeat --^                  (process/child.h)
 *   samples --feeder: a thread--> its second pipe
 *
 * There are places for two frames: one that is written, and one that waits. Pixels are exchanged
 * for those of a free place, not copied; a frame that is shown again is queued again.
 *
 * INVARIANT: frames are written in the order in which they were given, each as often as it was
 * given or repeated. An encoder that failed is closed already.
 */
#pragma once

#include <pthread.h>
#include <stdatomic.h>

#include "common/sound_stream.h"
#include "inside/context.h"
#include "process/child.h"

/* A thread that writes the samples of a sound to an encoder, as they are wanted.
 *
 *   cs_sound_stream --read--> feeder --pipe--> encoder, which may want only the first of them
 *
 * INVARIANT: the descriptor is closed when the thread has ended, and the samples when the feeder is
 * finished.
 */
typedef struct cs_feeder {
  celspan_context branch;  /* the branch of the thread */
  cs_sound_stream samples; /* owned */
  int descriptor;
  cs_thread thread;
  atomic_int status; /* a celspan_status; its sentence is in the branch */
  bool is_open;
} cs_feeder;

enum { CS_ENCODER_PLACES = 2, CS_ENCODER_QUEUE = 64 };

typedef struct cs_encoder {
  celspan_context *context; /* borrowed */
  const char *name;         /* the name of the film, for messages; borrowed */
  cs_child process;
  size_t frame_size;
  cs_thread writer;
  cs_feeder feeder;      /* the feeder of the sound, if there is one */
  pthread_mutex_t mutex; /* protects all fields below */
  pthread_cond_t changed;
  struct {
    unsigned char *pixels; /* owned */
    size_t queued;         /* how often it is queued or being written */
  } places[CS_ENCODER_PLACES];
  int queue[CS_ENCODER_QUEUE]; /* the queue of places; a ring */
  size_t head, waiting;
  int last; /* place of the frame given last; -1: none */
  bool is_complete, is_broken, is_done;
  int error;    /* the error of a failed write, except a closed pipe; 0: none */
  bool is_open; /* used by the calling thread only */
} cs_encoder;

/* Starts the encoder, whose arguments begin with its name. *samples: moved to the encoder, if there
 * are some. out: must not move while it is open. Errors: OUTPUT, if it cannot be started; LIMIT;
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_encoder_open(cs_encoder *out, celspan_context *context,
                                               const char *name, const char *const *arguments,
                                               size_t frame_size, cs_sound_stream *samples);
/* Exchanges the pixels of the next frame for others of the same size that are free, from
 * cs_mem_resize like those; waits until there are such. Errors: OUTPUT, with the message of an
 * encoder that has ended; those of the samples; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_encoder_give(cs_encoder *encoder, unsigned char **pixels);
/* Repeats the frame given last. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_encoder_repeat(cs_encoder *encoder);
/* Waits until all frames are written and the encoder has succeeded, and closes it. Errors: as
 * above. */
CELSPAN_CHECKED celspan_status cs_encoder_finish(cs_encoder *encoder);
/* Runs a program that gets nothing to read, until it ends. name: of the film, for messages. Errors:
 * OUTPUT, CANCELLED, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_encoder_run(celspan_context *context, const char *name,
                                              const char *const *arguments);
/* Kills the encoder and closes it, unless it is closed already. */
void cs_encoder_discard(cs_encoder *encoder);
