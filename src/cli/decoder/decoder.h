/* Decoders (server.h) as the program has them: taken, asked, given back.
 *
 *   reader, reader, ... --take--> decoder, one request at a time
 *   writer -------------take--> a decoder of its own
 *
 * There are as many decoders as readers are open at a time, at most CS_DECODERS_MOST and one a
 * processor: readers beyond that share. One that dies, that is late or that runs out of memory is
 * ended; its other readers are opened again in others.
 *
 * INVARIANT: who calls cs_decoder_ask has the decoder locked, from before its shared memory is filled
 * until after it was copied. A writer needs no lock: it is one user's, who may go from thread to
 * thread.
 */
#ifndef CS_CLI_DECODER_DECODER_H
#define CS_CLI_DECODER_DECODER_H

#include <pthread.h>

#include "cli/decoder/message.h"

enum { CS_DECODERS_MOST = 8 };

typedef struct cs_decoder_limits {
  uint64_t memory; /* bytes that decoding may take; 0: any */
  double seconds;  /* that opening a picture, or reading a part of it, may take; 0: any */
} cs_decoder_limits;

typedef struct cs_decoder {
  struct cs_decoder *next;
  bool is_writer;
  bool has_served;       /* a reader before the present one */
  int users;             /* readers, or the writer */
  uint32_t number;       /* in the keeper */
  int socket;            /* -1: it has ended */
  int ending;            /* then: how, as cs_keeping_end tells it */
  unsigned char *shared; /* CS_SHARED bytes */
  pthread_mutex_t asking;
} cs_decoder;

typedef enum cs_decoder_outcome {
  CS_DECODER_ANSWERED,
  CS_DECODER_DIED,
  CS_DECODER_LATE,
  CS_DECODER_ASTRAY, /* it answered what no decoder does */
  CS_DECODER_STOPPED /* by a signal to the program */
} cs_decoder_outcome;

typedef struct cs_decoder_request {
  cs_message *message; /* becomes the answer */
  int descriptor;      /* sent along; -1: none */
  /* For what comes before the answer: whether to go on. NULL: nothing may come. */
  bool (*put)(void *user, const cs_message *message);
  void *user;
} cs_decoder_request;

/* "FILE: reason". The answer is the status. */
celspan_status cs_decoder_fail(cs_picture_failure *failure, celspan_status status, const char *file,
                               const char *reason);
/* Sets the limits of all decoders; before the first one. */
void cs_decoder_limit(const cs_decoder_limits *limits);
/* is_fresh: one that has served nobody. Errors: as cs_keeping_start. */
celspan_status cs_decoder_take(bool is_writer, bool is_fresh, cs_decoder **out,
                               cs_picture_failure *failure);
void cs_decoder_leave(cs_decoder *decoder);
/* Ends all; nobody has one any more. */
void cs_decoder_finish(void);

void cs_decoder_lock(cs_decoder *decoder);
void cs_decoder_unlock(cs_decoder *decoder);
/* Any outcome but ANSWERED has ended the decoder. */
cs_decoder_outcome cs_decoder_ask(cs_decoder *decoder, const cs_decoder_request *request);
/* Ends a decoder that has not ended. */
void cs_decoder_end(cs_decoder *decoder);
/* Ends a decoder if it has served others before: a fresh one may have memory that it has not. Whether
 * it did. */
bool cs_decoder_retire(cs_decoder *decoder);
/* Puts the texts one after the other into shared memory, NULL as "". false: they are too long. */
bool cs_decoder_put_texts(const cs_decoder *decoder, const char *const *texts, size_t count);
/* The failure that an outcome is, ANSWERED being a lack of memory, without the file's name. other: the status of most. */
celspan_status cs_decoder_explain(const cs_decoder *decoder, cs_decoder_outcome outcome,
                                  celspan_status other, cs_picture_failure *failure);

#endif
