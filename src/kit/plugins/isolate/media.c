#include "plugins/isolate/media.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "inside/clock.h"
#include "plugins/isolate/client.h"
#include "plugins/isolate/media_worker.h"
#include "plugins/isolate/worker.h"
#include "process/interrupt.h"
#include "process/spawn.h"

enum {
  PAUSE = 50,          /* milliseconds between two checks for a signal to stop */
  PIPE_BYTES = 1 << 20 /* the most that a system gives without being asked by its owner */
};

/* ---------------------------------------------------------------- failures */

static bool is_late(const cs_media *m, double since, bool is_ready) {
  double now = cs_clock_seconds();
  bool is_stuck = !is_ready && now - since > m->seconds;
  bool is_over = m->shares > 0 && now - m->begin > m->shares * m->seconds;
  return m->seconds > 0 && (is_stuck || is_over);
}

static celspan_status fail_late(const cs_media *m, celspan_context *context) {
  if (m->shares > 0)
    return cs_fail(
        context, CELSPAN_LIMIT,
        "the %s %s cannot be read: its %s was not whole after %.3g seconds, or came to a "
        "halt, and reading was stopped (--limit picture-time=SECONDS)",
        m->noun, m->path, m->unit, cs_clock_seconds() - m->begin);
  return cs_fail(context, CELSPAN_LIMIT,
                 "the %s %s cannot be read: for %g seconds no %s came of it, and decoding was "
                 "stopped (--limit picture-time=SECONDS)",
                 m->noun, m->path, m->seconds, m->unit);
}

/* Removes the name under which the worker has opened the file, because many messages begin with
 * it. */
static void remove_name(cs_words *words) {
  static const char name[] = CS_MEDIA_WORKER_FILE ": ";
  for (char *at; (at = strstr(words->text, name));) {
    memmove(at, at + strlen(name), strlen(at + strlen(name)) + 1);
    words->size -= strlen(name);
  }
}

/* Whether the worker had no memory. A system without memory kills processes. */
static bool is_starved(const cs_media *m, int ending) {
  return ending == -1 || (WIFSIGNALED(ending) && WTERMSIG(ending) == SIGKILL) ||
         strstr(m->words.text, "Cannot allocate memory") ||
         strstr(m->words.text, "failed to map segment");
}

/* The failure of ffmpeg. ending: the status of waitpid; -1: it is not known. */
static celspan_status fail_ending(cs_media *m, celspan_context *context, int ending) {
  char how[CS_WORDS + 64];
  bool is_exit = ending != -1 && WIFEXITED(ending);
  remove_name(&m->words);
  if (is_exit && WEXITSTATUS(ending) == CS_MEDIA_WORKER_MISSING)
    return cs_fail(context, CELSPAN_OUTPUT,
                   "the %s %s cannot be read: %s, which reads %ss, is not in PATH: install the "
                   "package ffmpeg",
                   m->noun, m->path, m->program, m->noun);
  if (is_starved(m, ending))
    return cs_fail(context, CELSPAN_NO_MEMORY,
                   "the %s %s cannot be read: out of memory: decoding it needs more than %llu "
                   "MiB, or than the system has (--limit picture-memory=SIZE)",
                   m->noun, m->path, (unsigned long long)(m->memory >> 20));
  cs_words_describe(&m->words, ending, how, sizeof how);
  return cs_fail(context, CELSPAN_INPUT, "the %s %s cannot be read: %s %s", m->noun, m->path,
                 m->program, how);
}

/* ---------------------------------------------------------------- what the worker sends */

static void hear(cs_media *m) {
  char bytes[CS_WORDS];
  ssize_t size = recv(m->socket, bytes, sizeof bytes, MSG_DONTWAIT);
  if (size > 0) {
    if (!m->hear || !m->hear(m->user, bytes, (size_t)size))
      cs_words_add(&m->words, bytes, (size_t)size);
  } else if (size == 0 || (errno != EINTR && errno != EAGAIN)) {
    close(m->socket);
    m->socket = -1;
  }
}

celspan_status cs_media_wait(cs_media *m, celspan_context *context, double since,
                             bool *is_readable) {
  bool is_ready = m->pipe < 0 && m->socket < 0, is_heard = false;
  while (!is_ready && !is_heard) {
    struct pollfd both[] = {{.fd = m->pipe, .events = POLLIN}, {.fd = m->socket, .events = POLLIN}};
    int count = poll(both, 2, PAUSE);
    if (cs_interrupt_signal() || atomic_load(&m->stops))
      return cs_fail(context, CELSPAN_CANCELLED, "%s: stopped", m->path);
    is_ready = count > 0 && both[0].revents;
    is_heard = count > 0 && both[1].revents;
    if (is_heard)
      hear(m);
    if (is_late(m, since, is_ready))
      return fail_late(m, context);
  }
  *is_readable = is_ready;
  return CELSPAN_OK;
}

celspan_status cs_media_read(cs_media *m, celspan_context *context, unsigned char *out, size_t size,
                             size_t *got) {
  double since = cs_clock_seconds();
  *got = 0;
  while (*got < size && m->pipe >= 0) {
    bool is_readable;
    celspan_status status = cs_media_wait(m, context, since, &is_readable);
    if (status != CELSPAN_OK)
      return atomic_load(&m->stops) ? CELSPAN_OK : status;
    if (!is_readable)
      continue;
    ssize_t part = read(m->pipe, out + *got, size - *got);
    if (part < 0 && errno == EINTR)
      continue;
    if (part <= 0)
      cs_media_shut(m);
    *got += part > 0 ? (size_t)part : 0;
    since = cs_clock_seconds();
  }
  return CELSPAN_OK;
}

void cs_media_shut(cs_media *m) {
  if (m->pipe >= 0)
    close(m->pipe);
  m->pipe = -1;
}

celspan_status cs_media_conclude(cs_media *m, celspan_context *context) {
  if (!m->has_worker)
    return CELSPAN_OK;
  double since = cs_clock_seconds();
  while (m->socket >= 0) {
    bool is_readable;
    celspan_status status = cs_media_wait(m, context, since, &is_readable);
    if (status != CELSPAN_OK)
      return status == CELSPAN_LIMIT ? status : CELSPAN_OK;
  }
  int ending = cs_client_end(m->number);
  m->has_worker = false;
  cs_words_join(&m->words);
  return ending == 0 ? CELSPAN_OK : fail_ending(m, context, ending);
}

void cs_media_close(cs_media *m) {
  if (m->has_worker)
    cs_client_end(m->number);
  cs_media_shut(m);
  if (m->socket >= 0)
    close(m->socket);
  m->has_worker = false;
  m->socket = -1;
}

/* ---------------------------------------------------------------- its start */

static celspan_status start_worker(cs_media *m, celspan_context *context, cs_worker_task task,
                                   const int ends[2]) {
  const cs_worker_limits limits = cs_worker_limits_set();
  const cs_message_start start = {
      .memory = limits.memory ? limits.memory + CS_MEDIA_WORKER_LOADED : 0, .task = (int32_t)task};
  cs_picture_failure failure;
  m->program = task == CS_WORKER_LISTS ? "ffprobe" : "ffmpeg";
  m->begin = cs_clock_seconds();
  m->seconds = limits.seconds;
  m->memory = limits.memory;
  m->pipe = ends[0];
  celspan_status status = cs_client_start(&start, ends[1], &m->socket, &m->number, &failure);
  close(ends[1]);
  if (status != CELSPAN_OK)
    return cs_fail(context, status, "the %s %s cannot be read: %s", m->noun, m->path, failure.text);
  m->has_worker = true;
  return CELSPAN_OK;
}

/* Some systems have no processes for us, such as WebAssembly: no more memory would help there. */
static celspan_status fail_pipe(const cs_media *m, celspan_context *context, int error) {
  if (error == ENOSYS)
    return cs_fail(context, CELSPAN_OUTPUT,
                   "the %s %s cannot be read: ffmpeg reads %ss, and celspan cannot start other "
                   "programs on this system",
                   m->noun, m->path, m->noun);
  return cs_fail(context, CELSPAN_NO_MEMORY, "the %s %s cannot be read: no pipe: %s", m->noun,
                 m->path, strerror(error));
}

celspan_status cs_media_start(cs_media *m, celspan_context *context, cs_worker_task task,
                              const cs_message *message, int descriptor) {
  int ends[2];
  int error = cs_spawn_pipe(ends);
  if (error)
    return fail_pipe(m, context, error);
  (void)fcntl(ends[0], F_SETPIPE_SZ, PIPE_BYTES); /* the usual size is enough, but slower */
  CS_TRY(start_worker(m, context, task, ends));
  /* If the message cannot be sent, the worker has ended, and the first read finds this. */
  (void)!cs_message_send(m->socket, message, descriptor);
  return CELSPAN_OK;
}
