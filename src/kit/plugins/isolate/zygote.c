#include "plugins/isolate/zygote.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/pictures.h"
#include "plugins/isolate/media_worker.h"
#include "plugins/isolate/strict.h"

enum { WORKERS = 256 };

typedef struct zygote {
  celspan_context *context;
  const cs_picture_module *module; /* NULL: not loaded yet */
  const cs_colour_module *colour;  /* likewise */
  cs_roots roots;
  bool has_roots;
  pid_t workers[WORKERS]; /* by their numbers; 0: none */
} zygote;

bool cs_zygote_is_meant(int count, char **arguments) {
  int type = 0;
  socklen_t size = sizeof type;
  return count > 1 && strcmp(arguments[1], CS_ZYGOTE_ARGUMENT) == 0 &&
         getsockopt(CS_ZYGOTE_SOCKET, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         type == SOCK_SEQPACKET;
}

/* ---------------------------------------------------------------- the end of workers */

/* A worker that runs ffmpeg leads a group, which contains all processes that it has started. */
static void kill_worker(pid_t worker) {
  kill(worker, SIGKILL);
  kill(-worker, SIGKILL);
}

/* Ends a worker, unless it has ended by itself. Returns the status of waitpid. */
static int end_worker(zygote *z, uint32_t number) {
  int ending = 0;
  if (number >= WORKERS || !z->workers[number])
    return 0;
  kill_worker(z->workers[number]);
  while (waitpid(z->workers[number], &ending, 0) < 0 && errno == EINTR)
    continue;
  z->workers[number] = 0;
  return ending;
}

static _Noreturn void finish(zygote *z) {
  for (uint32_t number = 0; number < WORKERS; number++)
    if (z->workers[number])
      kill_worker(z->workers[number]);
  for (uint32_t number = 0; number < WORKERS; number++)
    end_worker(z, number);
  _exit(0);
}

/* ---------------------------------------------------------------- the start of workers */

static uint32_t free_number(const zygote *z) {
  uint32_t number = 0;
  while (number < WORKERS && z->workers[number])
    number++;
  return number;
}

/* Called in the forked process. */
static _Noreturn void become_worker(const zygote *z, const cs_message_start *start, pid_t parent,
                                    int socket, int memory) {
  const cs_worker_desc desc = {.module = z->module,
                               .colour = z->colour,
                               .roots = z->has_roots ? &z->roots : NULL,
                               .start = *start,
                               .zygote = parent,
                               .socket = socket,
                               .memory = memory};
  close(CS_ZYGOTE_SOCKET);
  if (start->task >= CS_WORKER_LISTENS)
    cs_media_worker_run(&desc);
  cs_worker_loop_run(&desc);
}

static void fail(cs_message *message, const char *what) {
  message->status = errno == ENOMEM || errno == EAGAIN ? CELSPAN_NO_MEMORY : CELSPAN_INPUT;
  snprintf(message->text, sizeof message->text, "%s: %s", what, strerror(errno));
}

/* Forks a worker. Returns the program's end of the worker's socket, or -1 and a message with the
 * reason. */
static int fork_worker(zygote *z, cs_message *message, int memory) {
  int ends[2];
  const cs_message_start start = message->start;
  const pid_t self = getpid();
  message->number = free_number(z);
  errno = EAGAIN;
  if (message->number == WORKERS ||
      socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    fail(message, "a decoder cannot be created");
    return -1;
  }
  pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    become_worker(z, &start, self, ends[1], memory);
  }
  close(ends[1]);
  if (child > 0) {
    z->workers[message->number] = child;
    return ends[0];
  }
  fail(message, "a decoder cannot be forked");
  close(ends[0]);
  return -1;
}

/* Ends this process by SIGALRM after the given number of seconds; 0: never. */
static void set_alarm(double seconds) {
  double whole = floor(seconds);
  const struct itimerval timer = {
      .it_value = {.tv_sec = (time_t)whole, .tv_usec = (suseconds_t)((seconds - whole) * 1e6)}};
  setitimer(ITIMER_REAL, &timer, NULL);
}

/* A library without memory may deadlock, as GLib does. */
static celspan_status load(zygote *z, const cs_message_start *start) {
  celspan_status status = CELSPAN_OK;
  set_alarm(start->loading);
  if (start->task == CS_WORKER_SAMPLES && !z->colour)
    status = cs_profile_table_module(z->context, &z->colour);
  else if (start->task < CS_WORKER_SAMPLES && !z->module)
    status = cs_store_module(
        z->context, start->task == CS_WORKER_WRITES ? CELSPAN_OUTPUT : CELSPAN_INPUT, &z->module);
  set_alarm(0);
  return status;
}

static void start_worker(zygote *z, cs_message *message, int memory) {
  int socket = -1;
  celspan_status status = load(z, &message->start);
  message->kind = CS_MESSAGE_DONE;
  message->status = status;
  if (status != CELSPAN_OK)
    snprintf(message->text, sizeof message->text, "%s", celspan_context_error(z->context));
  else
    socket = fork_worker(z, message, memory);
  bool is_sent = cs_message_send(CS_ZYGOTE_SOCKET, message, socket);
  if (socket >= 0)
    close(socket);
  if (!is_sent)
    finish(z);
}

/* ---------------------------------------------------------------- serving */

static void serve(zygote *z) {
  int memory;
  cs_message message;
  if (cs_message_wait(CS_ZYGOTE_SOCKET, CS_MESSAGE_PATIENCE, &message, &memory) !=
      CS_MESSAGE_ARRIVED)
    finish(z);
  errno = 0;
  if (message.kind == CS_MESSAGE_START) {
    start_worker(z, &message, memory);
  } else {
    message.ending = end_worker(z, message.number);
    message.kind = CS_MESSAGE_DONE;
    if (!cs_message_send(CS_ZYGOTE_SOCKET, &message, -1))
      finish(z);
  }
  if (memory >= 0)
    close(memory);
}

void cs_zygote_run(int count, char **arguments) {
  static zygote z;
  prctl(PR_SET_NAME, "celspan-decoder");
  cs_strict_close(CS_ZYGOTE_SOCKET + 1);
  cs_worker_loop_watch_faults();
  if (celspan_context_create(NULL, &z.context) != CELSPAN_OK)
    _exit(CS_WORKER_NO_MEMORY);
  z.has_roots = count > 2;
  for (int i = 2; i < count; i++)
    if (!cs_roots_add(&z.roots, arguments[i]))
      _exit(CS_WORKER_NO_MEMORY);
  for (;;)
    serve(&z);
}
