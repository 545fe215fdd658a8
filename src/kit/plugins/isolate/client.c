#include "plugins/isolate/client.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inside/module.h"
#include "plugins/isolate/worker_loop.h"
#include "plugins/isolate/zygote.h"
#include "process/interrupt.h"
#include "process/spawn.h"

enum { PAUSE_MICROSECONDS = 50000 }; /* the pause between two checks for a signal to stop */

static struct {
  pthread_mutex_t lock;
  pid_t id;   /* 0: no zygote is running */
  int socket; /* to it */
} zygote = {.lock = PTHREAD_MUTEX_INITIALIZER};

/* ---------------------------------------------------------------- start and end */

/* Warnings of libraries are discarded; reports of sanitizers are not. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WORDS CS_SPAWN_SAME
#else
#define WORDS CS_SPAWN_NULL
#endif

/* 0 or an errno. The caller has locked the lock. */
static int spawn(const cs_roots *roots) {
  const char *arguments[CS_ROOTS_MOST + 3] = {"celspan-decoder", CS_ZYGOTE_ARGUMENT};
  const struct timeval pause = {.tv_usec = PAUSE_MICROSECONDS};
  int ends[2];
  for (size_t i = 0; roots && i < roots->count; i++)
    arguments[i + 2] = roots->paths[i];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    return errno;
  const int files[] = {CS_SPAWN_NULL, CS_SPAWN_NULL, WORDS, ends[1]};
  setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &pause, sizeof pause);
  const cs_spawn_desc desc = {.path = cs_program_path(),
                              .arguments = arguments,
                              .files = files,
                              .file_count = CS_ZYGOTE_SOCKET + 1};
  int error = cs_spawn(&zygote.id, &desc);
  close(ends[1]);
  if (error) {
    close(ends[0]);
    zygote.id = 0;
  }
  zygote.socket = ends[0];
  return error;
}

/* Waits for the end of the zygote. Returns the status of waitpid. The caller has locked the
 * lock. */
static int finish(void) {
  int ending = 0;
  close(zygote.socket);
  while (waitpid(zygote.id, &ending, 0) < 0 && errno == EINTR)
    continue;
  zygote.id = 0;
  return ending;
}

bool cs_client_confine(const cs_roots *roots) {
  pthread_mutex_lock(&zygote.lock);
  errno = zygote.id ? 0 : spawn(roots);
  pthread_mutex_unlock(&zygote.lock);
  return errno == 0;
}

void cs_client_finish(void) {
  pthread_mutex_lock(&zygote.lock);
  if (zygote.id)
    finish();
  pthread_mutex_unlock(&zygote.lock);
}

/* ---------------------------------------------------------------- requests */

/* Sends a message and receives the answer, unless a signal asks to stop. */
static cs_message_arrival ask(cs_message *message, int enclosed, int *received) {
  cs_message_arrival arrival = CS_MESSAGE_OVER;
  if (cs_message_send(zygote.socket, message, enclosed))
    do
      arrival = cs_message_receive(zygote.socket, message, received);
    while (arrival == CS_MESSAGE_LATE && !(received && cs_interrupt_signal()));
  return arrival;
}

static celspan_status fail(cs_picture_failure *failure, celspan_status status, const char *text) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s", text);
  return status;
}

static celspan_status explain_late(const cs_message_start *desc, cs_picture_failure *failure) {
  failure->status = CELSPAN_LIMIT;
  snprintf(failure->text, sizeof failure->text,
           "loading %s took more than %g seconds and was stopped (ten times --limit "
           "picture-time=SECONDS)",
           desc->task == CS_WORKER_SAMPLES ? "Little CMS" : "OpenImageIO", desc->loading);
  return CELSPAN_LIMIT;
}

/* Explains why the zygote did not answer. The caller has locked the lock. */
static celspan_status explain(cs_message_arrival arrival, const cs_message_start *desc,
                              celspan_status other, cs_picture_failure *failure) {
  int ending = finish();
  if (arrival == CS_MESSAGE_LATE)
    return fail(failure, CELSPAN_CANCELLED, "a signal asked to stop");
  if (cs_worker_loop_is_starved(ending))
    return fail(failure, CELSPAN_NO_MEMORY,
                "out of memory or processes while starting the picture decoder");
  if (WIFSIGNALED(ending) && WTERMSIG(ending) == SIGALRM)
    return explain_late(desc, failure);
  fail(failure, other, "");
  snprintf(failure->text, sizeof failure->text,
           "the picture decoder ended during its start (%s %d); --trust runs without it",
           WIFSIGNALED(ending) ? "signal" : "exit code",
           WIFSIGNALED(ending) ? WTERMSIG(ending) : WEXITSTATUS(ending));
  return other;
}

celspan_status cs_client_refuse(int error, celspan_status other, cs_picture_failure *failure) {
  bool is_starved = error == ENOMEM || error == EAGAIN;
  fail(failure, is_starved ? CELSPAN_NO_MEMORY : other, "");
  snprintf(failure->text, sizeof failure->text,
           "the picture decoder cannot be started: %s%s; --trust runs without it",
           is_starved ? "out of memory: " : "", strerror(error));
  return failure->status;
}

/* The caller has locked the lock. */
static celspan_status start(cs_message *message, int memory, int *socket,
                            cs_picture_failure *failure) {
  const cs_message_start desc = message->start;
  celspan_status other = desc.task == CS_WORKER_WRITES ? CELSPAN_OUTPUT : CELSPAN_INPUT;
  const struct timeval pause = {.tv_usec = PAUSE_MICROSECONDS};
  int error = zygote.id ? 0 : spawn(NULL);
  if (error)
    return cs_client_refuse(error, other, failure);
  cs_message_arrival arrival = ask(message, memory, socket);
  if (arrival != CS_MESSAGE_ARRIVED)
    return explain(arrival, &desc, other, failure);
  if (message->status != CELSPAN_OK || *socket < 0)
    return fail(failure, message->status ? (celspan_status)message->status : other, message->text);
  setsockopt(*socket, SOL_SOCKET, SO_RCVTIMEO, &pause, sizeof pause);
  return CELSPAN_OK;
}

celspan_status cs_client_start(const cs_message_start *desc, int memory, int *socket,
                               uint32_t *number, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_START, .start = *desc};
  pthread_mutex_lock(&zygote.lock);
  celspan_status status = start(&message, memory, socket, failure);
  pthread_mutex_unlock(&zygote.lock);
  *number = message.number;
  return status;
}

int cs_client_end(uint32_t number) {
  cs_message message = {.kind = CS_MESSAGE_END, .number = number};
  int ending = -1;
  pthread_mutex_lock(&zygote.lock);
  if (zygote.id && ask(&message, -1, NULL) == CS_MESSAGE_ARRIVED)
    ending = message.ending;
  else if (zygote.id)
    finish();
  pthread_mutex_unlock(&zygote.lock);
  return ending;
}
