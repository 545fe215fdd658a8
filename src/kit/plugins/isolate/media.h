/* What ffmpeg writes in a worker (media_worker.h), as a stream of bytes.
 *
 * INVARIANT: everything that comes from it is checked by its reader, because a malicious file may
 * control the worker. A worker that sends nothing for the time limit of pictures is ended, and it
 * ends with this program in any case.
 */
#pragma once

#include <stdatomic.h>

#include "inside/context.h"
#include "plugins/isolate/message.h"
#include "process/words.h"

typedef struct cs_media {
  const char *noun, *unit, *path; /* for messages: "sound", "samples"; borrowed */
  const char *program;            /* which the worker becomes */
  int pipe, socket;               /* what the worker writes, and says; -1: closed */
  uint32_t number;                /* the number of the worker in the zygote */
  bool has_worker;
  cs_words words;    /* the last words of the worker */
  double seconds;    /* the most seconds until more arrives; 0: any */
  double shares;     /* the most seconds for all, in multiples of these; 0: any */
  double begin;      /* when the worker began, by the clock */
  uint64_t memory;   /* the limit; 0: any */
  atomic_bool stops; /* a read must end */
  /* Gets what the worker says, and returns whether these were no words. NULL: all are words. */
  bool (*hear)(void *user, const char *bytes, size_t size);
  void *user;
} cs_media;

/* The form of a stream that is not open. */
#define CS_MEDIA(noun_, unit_, path_)                                                              \
  { .noun = (noun_), .unit = (unit_), .path = (path_), .pipe = -1, .socket = -1 }

/* Starts the worker. message: OPEN, with the name of the format; descriptor: of the file, borrowed.
 * Errors: NO_MEMORY, INPUT, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_media_start(cs_media *media, celspan_context *context,
                                              cs_worker_task task, const cs_message *message,
                                              int descriptor);
/* Reads `size` bytes, or fewer at the end. Errors: LIMIT, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_media_read(cs_media *media, celspan_context *context,
                                             unsigned char *out, size_t size, size_t *got);
/* Waits until the pipe or the socket has something, and hears what is said. since: the time by the
 * clock from which the limit counts. *is_readable: the pipe can be read, or both are closed. When
 * bytes can be read, what was said before they were written can be heard.
 * Errors: LIMIT, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_media_wait(cs_media *media, celspan_context *context,
                                             double since, bool *is_readable);
/* Closes the pipe, so that a worker that would write more ends. */
void cs_media_shut(cs_media *media);
/* The outcome of the worker after its last byte. Errors: INPUT, with the words of ffmpeg; OUTPUT,
 * if there is no ffmpeg; NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_media_conclude(cs_media *media, celspan_context *context);
/* Ends the worker. */
void cs_media_close(cs_media *media);
