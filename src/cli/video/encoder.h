/* Frames on their way into an encoder, which works while the next ones are made.
 *
 *   take: a free place --> pixels --> give --> queue --thread--> the encoder's standard input
 *                                    repeat --^                  (cli/video/process.h)
 *
 * There is room for three frames: one that is written, one that waits, one that is made. A frame
 * that is shown again is queued again and not copied.
 *
 * INVARIANT: frames are written in the order in which they were given, each as often as it was
 * given or repeated. An encoder that failed is closed already.
 */
#ifndef CS_CLI_VIDEO_ENCODER_H
#define CS_CLI_VIDEO_ENCODER_H

#include <pthread.h>

#include "cli/video/process.h"

enum { CS_ENCODER_PLACES = 3, CS_ENCODER_QUEUE = 64 };

typedef struct cs_encoder {
  celspan_context *context; /* borrowed */
  const char *name;         /* of the film, for messages; borrowed */
  cs_process process;
  size_t frame_size;
  cs_thread writer;
  pthread_mutex_t mutex; /* of all that follows */
  pthread_cond_t changed;
  struct {
    unsigned char *pixels; /* owned */
    size_t queued;         /* how often it is in the queue, or being written */
  } places[CS_ENCODER_PLACES];
  int queue[CS_ENCODER_QUEUE]; /* of places; a ring */
  size_t head, waiting;
  int last; /* place of the frame given last; -1: none */
  bool is_complete, is_broken, is_done;
  int error;    /* that broke it, other than that nobody reads; 0: none */
  bool is_open; /* of the calling thread alone */
} cs_encoder;

/* Starts the encoder, whose arguments begin with its name. out: stays where it is while it is open.
 * Errors: OUTPUT, where it cannot be started; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_encoder_open(cs_encoder *out, celspan_context *context,
                                               const char *name, const char *const *arguments,
                                               size_t frame_size);
/* A place for the next frame's pixels. Errors: OUTPUT, with the last words of an encoder that has
 * ended; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_encoder_take(cs_encoder *encoder, int *place);
unsigned char *cs_encoder_pixels(const cs_encoder *encoder, int place);
void cs_encoder_give(cs_encoder *encoder, int place);
/* Shows the frame given last once more. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_encoder_repeat(cs_encoder *encoder);
/* Closes it after all frames are written and it has ended well. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_encoder_finish(cs_encoder *encoder);
/* Closes it at once, whatever it is doing; one that is closed stays so. */
void cs_encoder_discard(cs_encoder *encoder);

#endif
