/* The pool of workers (worker_loop.h) in the program.
 *
 *   reader, reader, ... --take--> worker, one request at a time
 *   writer -------------take--> a worker of its own
 *   colour profile -----take--> worker, for this request
 *
 * There is one worker for each open reader, but at most CS_WORKERS_MOST and one for each processor;
 * further readers share workers. A worker that dies, exceeds its time or runs out of memory is
 * ended; its other readers are opened again in other workers.
 *
 * INVARIANT: the caller of cs_worker_ask has the worker locked, from before the shared memory is
 * filled until after the result was copied. A worker that writes needs no lock, because it has a
 * single user.
 */
#pragma once

#include <pthread.h>

#include "plugins/isolate/message.h"

enum { CS_WORKERS_MOST = 8 };

typedef struct cs_worker_limits {
  uint64_t memory; /* the most bytes for decoding; 0: any */
  double seconds;  /* the most seconds for opening a picture, or for reading a part of it; 0: any */
} cs_worker_limits;

typedef struct cs_worker {
  struct cs_worker *next;
  cs_worker_task task;
  bool has_served;       /* the process has served another reader before */
  int users;             /* readers, or the writer */
  uint32_t number;       /* in the zygote */
  int socket;            /* -1: the worker has ended */
  int ending;            /* the result of cs_client_end, if the worker has ended */
  unsigned char *shared; /* CS_SHARED bytes */
  pthread_mutex_t asking;
} cs_worker;

typedef enum cs_worker_outcome {
  CS_WORKER_ANSWERED,
  CS_WORKER_DIED,
  CS_WORKER_LATE,
  CS_WORKER_INVALID, /* the worker violated the protocol */
  CS_WORKER_STOPPED  /* a signal to the program stopped the wait */
} cs_worker_outcome;

typedef struct cs_worker_request {
  cs_message *message; /* replaced by the answer */
  int descriptor;      /* sent with the message; -1: none */
  /* Called for messages that precede the answer; returns whether to continue. NULL: such messages
   * are not allowed. */
  bool (*put)(void *user, const cs_message *message);
  void *user;
} cs_worker_request;

/* Sets "FILE: reason" and returns the status. */
celspan_status cs_worker_fail(cs_picture_failure *failure, celspan_status status, const char *file,
                              const char *reason);
/* Sets the limits of all workers. Called before the first one starts. */
void cs_worker_limit(const cs_worker_limits *limits, int most);
cs_worker_limits cs_worker_limits_set(void);
/* is_fresh: the worker must be new. Errors: those of cs_client_start. */
celspan_status cs_worker_take(cs_worker_task task, bool is_fresh, cs_worker **out,
                              cs_picture_failure *failure);
void cs_worker_leave(cs_worker *worker);
/* Ends all workers; they must have no users. */
void cs_worker_finish(void);

void cs_worker_lock(cs_worker *worker);
void cs_worker_unlock(cs_worker *worker);
/* Sends the request and waits for its answer. Any outcome except ANSWERED has ended the worker. */
cs_worker_outcome cs_worker_ask(cs_worker *worker, const cs_worker_request *request);
/* Ends a worker that has not ended. */
void cs_worker_end(cs_worker *worker);
/* Ends a worker if it has served other readers before, because a new one may have more memory left.
 * Returns whether it was ended. */
bool cs_worker_retire(cs_worker *worker);
/* Copies the texts into shared memory, one after the other; NULL becomes "". false: they are too
 * long. */
bool cs_worker_put_texts(const cs_worker *worker, const char *const *texts, size_t count);
/* Describes an outcome as a failure, without the file's name; ANSWERED stands for a lack of memory.
 * other: the status to use if no other one is more specific. */
celspan_status cs_worker_explain(const cs_worker *worker, cs_worker_outcome outcome,
                                 celspan_status other, cs_picture_failure *failure);
