#include "cli/decoder/keeper.h"

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

#include "base/context.h"
#include "cli/decoder/server.h"
#include "pictures/store.h"

enum { DECODERS = 256 };

typedef struct keeper {
  celspan_context *context;
  const cs_picture_module *module; /* NULL: not loaded yet */
  cs_roots roots;
  bool has_roots;
  pid_t decoders[DECODERS]; /* by their numbers; 0: none */
} keeper;

bool cs_keeper_is_meant(int count, char **arguments) {
  int type = 0;
  socklen_t size = sizeof type;
  return count > 1 && strcmp(arguments[1], CS_KEEPER_ARGUMENT) == 0 &&
         getsockopt(CS_KEEPER_SOCKET, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         type == SOCK_SEQPACKET;
}

/* ---------------------------------------------------------------- the end of decoders */

/* Ends a decoder, if it has not ended by itself. How it ended, as waitpid tells it. */
static int end_decoder(keeper *k, uint32_t number) {
  int ending = 0;
  if (number >= DECODERS || !k->decoders[number])
    return 0;
  kill(k->decoders[number], SIGKILL);
  while (waitpid(k->decoders[number], &ending, 0) < 0 && errno == EINTR)
    continue;
  k->decoders[number] = 0;
  return ending;
}

static _Noreturn void finish(keeper *k) {
  for (uint32_t number = 0; number < DECODERS; number++)
    if (k->decoders[number])
      kill(k->decoders[number], SIGKILL);
  for (uint32_t number = 0; number < DECODERS; number++)
    end_decoder(k, number);
  _exit(0);
}

/* ---------------------------------------------------------------- the start of decoders */

static uint32_t free_number(const keeper *k) {
  uint32_t number = 0;
  while (number < DECODERS && k->decoders[number])
    number++;
  return number;
}

/* In the process that was forked. */
static _Noreturn void become_decoder(const keeper *k, const cs_message_start *start, pid_t parent,
                                     int socket, int memory) {
  const cs_server_desc desc = {.module = k->module,
                               .roots = k->has_roots ? &k->roots : NULL,
                               .start = *start,
                               .keeper = parent,
                               .socket = socket,
                               .memory = memory};
  close(CS_KEEPER_SOCKET);
  cs_server_run(&desc);
}

static void fail(cs_message *message, const char *what) {
  message->status = errno == ENOMEM || errno == EAGAIN ? CELSPAN_NO_MEMORY : CELSPAN_INPUT;
  snprintf(message->text, sizeof message->text, "%s: %s", what, strerror(errno));
}

/* The program's end of the decoder's socket, or -1 and a message that tells why not. */
static int fork_decoder(keeper *k, cs_message *message, int memory) {
  int ends[2];
  const cs_message_start start = message->start;
  const pid_t self = getpid();
  message->number = free_number(k);
  errno = EAGAIN;
  if (message->number == DECODERS ||
      socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    fail(message, "a decoder of pictures cannot be made");
    return -1;
  }
  pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    become_decoder(k, &start, self, ends[1], memory);
  }
  close(ends[1]);
  if (child > 0) {
    k->decoders[message->number] = child;
    return ends[0];
  }
  fail(message, "a decoder of pictures cannot be forked");
  close(ends[0]);
  return -1;
}

/* Ends this process by SIGALRM after so many seconds; 0: never. */
static void set_alarm(double seconds) {
  double whole = floor(seconds);
  const struct itimerval timer = {
      .it_value = {.tv_sec = (time_t)whole, .tv_usec = (suseconds_t)((seconds - whole) * 1e6)}};
  setitimer(ITIMER_REAL, &timer, NULL);
}

/* A library that lacks memory may wait for itself for ever: GLib does so. */
static celspan_status load(keeper *k, const cs_message_start *start) {
  set_alarm(start->loading);
  celspan_status status =
      cs_store_module(k->context, start->is_writer ? CELSPAN_OUTPUT : CELSPAN_INPUT, &k->module);
  set_alarm(0);
  return status;
}

static void start_decoder(keeper *k, cs_message *message, int memory) {
  int socket = -1;
  celspan_status status = CELSPAN_OK;
  message->kind = CS_MESSAGE_DONE;
  if (!k->module)
    status = load(k, &message->start);
  message->status = status;
  if (status != CELSPAN_OK)
    snprintf(message->text, sizeof message->text, "%s", celspan_context_error(k->context));
  else
    socket = fork_decoder(k, message, memory);
  bool is_heard = cs_message_send(CS_KEEPER_SOCKET, message, socket);
  if (socket >= 0)
    close(socket);
  if (!is_heard)
    finish(k);
}

/* ---------------------------------------------------------------- keeping */

static void serve(keeper *k) {
  int memory;
  cs_message message;
  cs_message_arrival arrival = cs_message_receive(CS_KEEPER_SOCKET, &message, &memory);
  if (arrival == CS_MESSAGE_LATE)
    return;
  if (arrival != CS_MESSAGE_ARRIVED)
    finish(k);
  errno = 0;
  if (message.kind == CS_MESSAGE_START) {
    start_decoder(k, &message, memory);
  } else {
    message.ending = end_decoder(k, message.number);
    message.kind = CS_MESSAGE_DONE;
    if (!cs_message_send(CS_KEEPER_SOCKET, &message, -1))
      finish(k);
  }
  if (memory >= 0)
    close(memory);
}

void cs_keeper_run(int count, char **arguments) {
  static keeper k;
  prctl(PR_SET_NAME, "celspan-decoder");
  close_range(CS_KEEPER_SOCKET + 1, ~0U, 0);
  cs_server_watch_faults();
  if (celspan_context_create(NULL, &k.context) != CELSPAN_OK)
    _exit(CS_SERVER_NO_MEMORY);
  k.has_roots = count > 2;
  for (int i = 2; i < count; i++)
    if (!cs_roots_add(&k.roots, arguments[i]))
      _exit(CS_SERVER_NO_MEMORY);
  for (;;)
    serve(&k);
}
