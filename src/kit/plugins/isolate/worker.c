#include "plugins/isolate/worker.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inside/clock.h"
#include "plugins/isolate/client.h"
#include "plugins/isolate/worker_loop.h"
#include "process/interrupt.h"

enum { LOADING_PARTS = 10 }; /* loading the module may take as long as decoding this many parts */

static struct {
  pthread_mutex_t lock;
  cs_worker_limits limits;
  int most;        /* decoders at a time */
  cs_worker *list; /* the workers that have not ended */
} all = {.lock = PTHREAD_MUTEX_INITIALIZER};

void cs_worker_limit(const cs_worker_limits *limits, int most) {
  all.limits = *limits;
  all.most = most;
}

cs_worker_limits cs_worker_limits_set(void) { return all.limits; }

void cs_worker_lock(cs_worker *worker) { pthread_mutex_lock(&worker->asking); }

void cs_worker_unlock(cs_worker *worker) { pthread_mutex_unlock(&worker->asking); }

/* ---------------------------------------------------------------- one worker */

static bool is_writer(const cs_worker *worker) { return worker->task == CS_WORKER_WRITES; }

static void destroy(cs_worker *worker) {
  if (worker->shared)
    munmap(worker->shared, CS_SHARED);
  if (worker->socket >= 0)
    close(worker->socket);
  pthread_mutex_destroy(&worker->asking);
  free(worker);
}

/* Creates memory whose size neither side can change: reading beyond a reduced size would crash.
 * Returns a descriptor, or -1 and errno. */
static int share_memory(cs_worker *worker) {
  int memory = memfd_create("celspan pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (memory < 0)
    return -1;
  void *shared = MAP_FAILED;
  if (ftruncate(memory, (off_t)CS_SHARED) == 0 &&
      fcntl(memory, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0)
    shared = mmap(NULL, CS_SHARED, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
  if (shared != MAP_FAILED) {
    worker->shared = shared;
    return memory;
  }
  int error = errno;
  close(memory);
  errno = error;
  return -1;
}

static celspan_status fail(cs_picture_failure *failure, celspan_status status, const char *text) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s", text);
  return status;
}

static celspan_status start(cs_worker *worker, cs_picture_failure *failure) {
  const cs_message_start desc = {.memory = is_writer(worker) ? 0 : all.limits.memory,
                                 .loading = LOADING_PARTS * all.limits.seconds,
                                 .task = (int32_t)worker->task};
  int memory = share_memory(worker);
  if (memory < 0)
    return cs_client_refuse(errno, is_writer(worker) ? CELSPAN_OUTPUT : CELSPAN_INPUT, failure);
  celspan_status status = cs_client_start(&desc, memory, &worker->socket, &worker->number, failure);
  close(memory);
  return status;
}

static celspan_status create(cs_worker_task task, cs_worker **out, cs_picture_failure *failure) {
  cs_worker *worker = calloc(1, sizeof *worker);
  if (!worker)
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  worker->task = task;
  worker->socket = -1;
  pthread_mutex_init(&worker->asking, NULL);
  celspan_status status = start(worker, failure);
  return CS_GIVE(status, worker, destroy, out);
}

/* ---------------------------------------------------------------- the pool */

/* The worker with the fewest users; NULL if a new worker would be better. The caller has locked the
 * lock. */
static cs_worker *choose(cs_worker_task task) {
  cs_worker *best = NULL;
  int count = 0;
  for (cs_worker *at = all.list; at; at = at->next)
    if (at->task == task) {
      best = !best || at->users < best->users ? at : best;
      count++;
    }
  bool is_good = best && (best->users == 0 || (task != CS_WORKER_WRITES && count >= all.most));
  return is_good ? best : NULL;
}

celspan_status cs_worker_take(cs_worker_task task, bool is_fresh, cs_worker **out,
                              cs_picture_failure *failure) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&all.lock);
  cs_worker *worker = is_fresh ? NULL : choose(task);
  if (worker) {
    worker->has_served = true;
  } else {
    status = create(task, &worker, failure);
    if (status == CELSPAN_OK) {
      worker->next = all.list;
      all.list = worker;
    }
  }
  if (status == CELSPAN_OK) {
    worker->users++;
    *out = worker;
  }
  pthread_mutex_unlock(&all.lock);
  return status;
}

void cs_worker_leave(cs_worker *worker) {
  pthread_mutex_lock(&all.lock);
  bool is_last = --worker->users == 0 && worker->socket < 0;
  pthread_mutex_unlock(&all.lock);
  if (is_last)
    destroy(worker);
}

void cs_worker_end(cs_worker *worker) {
  int ending = cs_client_end(worker->number);
  pthread_mutex_lock(&all.lock);
  cs_worker **link = &all.list;
  while (*link != worker)
    link = &(*link)->next;
  *link = worker->next;
  close(worker->socket);
  worker->socket = -1;
  worker->ending = ending;
  pthread_mutex_unlock(&all.lock);
}

bool cs_worker_retire(cs_worker *worker) {
  pthread_mutex_lock(&all.lock);
  bool is_worn = worker->has_served;
  pthread_mutex_unlock(&all.lock);
  if (is_worn)
    cs_worker_end(worker);
  return is_worn;
}

void cs_worker_finish(void) {
  for (cs_worker *at = all.list, *next; at; at = next) {
    next = at->next;
    destroy(at);
  }
  all.list = NULL;
  cs_client_finish();
}

/* ---------------------------------------------------------------- asking */

bool cs_worker_put_texts(const cs_worker *worker, const char *const *texts, size_t count) {
  size_t at = 0;
  for (size_t i = 0; i < count; i++) {
    const char *text = texts[i] ? texts[i] : "";
    size_t size = strlen(text) + 1;
    if (size > CS_SHARED_PUT - at)
      return false;
    memcpy(worker->shared + at, text, size);
    at += size;
  }
  return true;
}

/* Handles a message that precedes the answer. Returns whether it was valid and could be
 * answered. */
static bool take_part(const cs_worker *worker, const cs_worker_request *request) {
  cs_message *message = request->message;
  bool is_known = message->kind == CS_MESSAGE_PART || message->kind == CS_MESSAGE_PUT;
  if (!is_known || !request->put)
    return false;
  bool continues = request->put(request->user, message);
  const cs_message reply = {.kind = message->kind,
                            .status = continues ? CELSPAN_OK : CELSPAN_CANCELLED};
  return cs_message_send(worker->socket, &reply, -1);
}

static cs_worker_outcome wait_for_answer(const cs_worker *worker,
                                         const cs_worker_request *request) {
  double start = cs_clock_seconds(), most = is_writer(worker) ? 0 : all.limits.seconds;
  for (;;) {
    cs_message_arrival arrival = cs_message_receive(worker->socket, request->message, NULL);
    bool has_arrived = arrival == CS_MESSAGE_ARRIVED;
    if (has_arrived && request->message->kind == CS_MESSAGE_DONE)
      return CS_WORKER_ANSWERED;
    if (arrival == CS_MESSAGE_OVER)
      return CS_WORKER_DIED;
    if (arrival == CS_MESSAGE_BAD || (has_arrived && !take_part(worker, request)))
      return CS_WORKER_INVALID;
    if (cs_interrupt_signal())
      return CS_WORKER_STOPPED;
    if (most > 0 && cs_clock_seconds() - start > most)
      return CS_WORKER_LATE;
  }
}

cs_worker_outcome cs_worker_ask(cs_worker *worker, const cs_worker_request *request) {
  cs_worker_outcome outcome = CS_WORKER_DIED;
  if (cs_message_send(worker->socket, request->message, request->descriptor))
    outcome = wait_for_answer(worker, request);
  if (outcome != CS_WORKER_ANSWERED)
    cs_worker_end(worker);
  return outcome;
}

/* ---------------------------------------------------------------- explaining */

celspan_status cs_worker_fail(cs_picture_failure *failure, celspan_status status, const char *file,
                              const char *reason) {
  failure->status = status;
  if (snprintf(failure->text, sizeof failure->text, "%s: %s", file, reason) < 0)
    failure->text[0] = '\0';
  return status;
}

static celspan_status explain_memory(const cs_worker *worker, cs_picture_failure *failure) {
  if (is_writer(worker) || !all.limits.memory)
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  failure->status = CELSPAN_NO_MEMORY;
  snprintf(failure->text, sizeof failure->text,
           "out of memory: decoding it needs more than %llu MiB, or than the system has "
           "(--limit picture-memory=SIZE)",
           (unsigned long long)(all.limits.memory >> 20));
  return CELSPAN_NO_MEMORY;
}

static celspan_status explain_death(const cs_worker *worker, celspan_status other,
                                    cs_picture_failure *failure) {
  int ending = worker->ending;
  if (ending == -1)
    return fail(failure, CELSPAN_NO_MEMORY,
                "the picture decoder was killed: the system may be out of memory");
  if (cs_worker_loop_is_starved(ending))
    return explain_memory(worker, failure);
  failure->status = other;
  if (WIFSIGNALED(ending))
    snprintf(failure->text, sizeof failure->text, "%s ended its decoder by signal %d (%s)%s",
             is_writer(worker) ? "writing it" : "it", WTERMSIG(ending), strsignal(WTERMSIG(ending)),
             is_writer(worker) ? "" : "; it is damaged or malicious");
  else
    snprintf(failure->text, sizeof failure->text, "%s ended its decoder with exit code %d",
             is_writer(worker) ? "writing it" : "it", WEXITSTATUS(ending));
  return other;
}

celspan_status cs_worker_explain(const cs_worker *worker, cs_worker_outcome outcome,
                                 celspan_status other, cs_picture_failure *failure) {
  if (outcome == CS_WORKER_STOPPED)
    return fail(failure, CELSPAN_CANCELLED, "a signal asked to stop");
  if (outcome == CS_WORKER_ANSWERED)
    return explain_memory(worker, failure);
  if (outcome == CS_WORKER_DIED)
    return explain_death(worker, other, failure);
  if (outcome == CS_WORKER_INVALID)
    return fail(failure, other, "its decoder sent an invalid answer; it is damaged or malicious");
  failure->status = CELSPAN_LIMIT;
  snprintf(failure->text, sizeof failure->text,
           "decoding a part of it took more than %g seconds and was stopped (--limit "
           "picture-time=SECONDS)",
           all.limits.seconds);
  return CELSPAN_LIMIT;
}
