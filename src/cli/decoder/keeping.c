#include "cli/decoder/keeping.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/decoder/keeper.h"
#include "cli/decoder/server.h"
#include "cli/interrupt.h"
#include "cli/spawn.h"

enum { PAUSE_MICROSECONDS = 50000 }; /* between two questions whether a signal asks to stop */

static struct {
  pthread_mutex_t lock;
  pid_t id;   /* 0: there is no keeper */
  int socket; /* to it */
} keeper = {.lock = PTHREAD_MUTEX_INITIALIZER};

/* ---------------------------------------------------------------- start and end */

/* What libraries say of a file is no message of the program, but what checks the program itself is. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WORDS CS_SPAWN_SAME
#else
#define WORDS CS_SPAWN_NULL
#endif

/* 0 or an errno. The lock is held. */
static int spawn(const cs_roots *roots) {
  const char *arguments[CS_ROOTS_MOST + 3] = {"celspan-decoder", CS_KEEPER_ARGUMENT};
  const struct timeval pause = {.tv_usec = PAUSE_MICROSECONDS};
  int ends[2];
  for (size_t i = 0; roots && i < roots->count; i++)
    arguments[i + 2] = roots->paths[i];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    return errno;
  const int files[] = {CS_SPAWN_NULL, CS_SPAWN_NULL, WORDS, ends[1]};
  setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &pause, sizeof pause);
  int error = cs_spawn(&keeper.id, "/proc/self/exe", arguments, files, CS_KEEPER_SOCKET + 1);
  close(ends[1]);
  if (error) {
    close(ends[0]);
    keeper.id = 0;
  }
  keeper.socket = ends[0];
  return error;
}

/* How the keeper ended, as waitpid tells it. The lock is held. */
static int finish(void) {
  int ending = 0;
  close(keeper.socket);
  while (waitpid(keeper.id, &ending, 0) < 0 && errno == EINTR)
    continue;
  keeper.id = 0;
  return ending;
}

bool cs_keeping_confine(const cs_roots *roots) {
  pthread_mutex_lock(&keeper.lock);
  errno = keeper.id ? 0 : spawn(roots);
  pthread_mutex_unlock(&keeper.lock);
  return errno == 0;
}

void cs_keeping_finish(void) {
  pthread_mutex_lock(&keeper.lock);
  if (keeper.id)
    finish();
  pthread_mutex_unlock(&keeper.lock);
}

/* ---------------------------------------------------------------- questions */

/* Sends a message and gets the answer to it, unless a signal asks to stop. */
static cs_message_arrival ask(cs_message *message, int enclosed, int *received) {
  cs_message_arrival arrival = CS_MESSAGE_OVER;
  if (cs_message_send(keeper.socket, message, enclosed))
    do
      arrival = cs_message_receive(keeper.socket, message, received);
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
           "loading OpenImageIO took more than %g seconds, and was given up (ten times --limit "
           "picture-time=SECONDS)",
           desc->loading);
  return CELSPAN_LIMIT;
}

/* The keeper did not answer. The lock is held. */
static celspan_status explain(cs_message_arrival arrival, const cs_message_start *desc,
                              celspan_status other, cs_picture_failure *failure) {
  int ending = finish();
  if (arrival == CS_MESSAGE_LATE)
    return fail(failure, CELSPAN_CANCELLED, "a signal asked to stop");
  if (cs_server_is_starved(ending))
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory in starting the decoder of pictures");
  if (WIFSIGNALED(ending) && WTERMSIG(ending) == SIGALRM)
    return explain_late(desc, failure);
  fail(failure, other, "");
  snprintf(failure->text, sizeof failure->text,
           "the decoder of pictures ended before it began (%s %d); --trust does without it",
           WIFSIGNALED(ending) ? "signal" : "exit code",
           WIFSIGNALED(ending) ? WTERMSIG(ending) : WEXITSTATUS(ending));
  return other;
}

celspan_status cs_keeping_refuse(int error, celspan_status other, cs_picture_failure *failure) {
  bool is_starved = error == ENOMEM || error == EAGAIN;
  fail(failure, is_starved ? CELSPAN_NO_MEMORY : other, "");
  snprintf(failure->text, sizeof failure->text,
           "the decoder of pictures cannot be started: %s%s; --trust does without it",
           is_starved ? "out of memory: " : "", strerror(error));
  return failure->status;
}

/* The lock is held. */
static celspan_status start(cs_message *message, int memory, int *socket,
                            cs_picture_failure *failure) {
  const cs_message_start desc = message->start;
  celspan_status other = desc.is_writer ? CELSPAN_OUTPUT : CELSPAN_INPUT;
  const struct timeval pause = {.tv_usec = PAUSE_MICROSECONDS};
  int error = keeper.id ? 0 : spawn(NULL);
  if (error)
    return cs_keeping_refuse(error, other, failure);
  cs_message_arrival arrival = ask(message, memory, socket);
  if (arrival != CS_MESSAGE_ARRIVED)
    return explain(arrival, &desc, other, failure);
  if (message->status != CELSPAN_OK || *socket < 0)
    return fail(failure, message->status ? (celspan_status)message->status : other, message->text);
  setsockopt(*socket, SOL_SOCKET, SO_RCVTIMEO, &pause, sizeof pause);
  return CELSPAN_OK;
}

celspan_status cs_keeping_start(const cs_message_start *desc, int memory, int *socket,
                                uint32_t *number, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_START, .start = *desc};
  pthread_mutex_lock(&keeper.lock);
  celspan_status status = start(&message, memory, socket, failure);
  pthread_mutex_unlock(&keeper.lock);
  *number = message.number;
  return status;
}

int cs_keeping_end(uint32_t number) {
  cs_message message = {.kind = CS_MESSAGE_END, .number = number};
  int ending = -1;
  pthread_mutex_lock(&keeper.lock);
  if (keeper.id && ask(&message, -1, NULL) == CS_MESSAGE_ARRIVED)
    ending = message.ending;
  else if (keeper.id)
    finish();
  pthread_mutex_unlock(&keeper.lock);
  return ending;
}
