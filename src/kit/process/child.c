#include "process/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "inside/clock.h"
#include "process/interrupt.h"
#include "process/spawn.h"

#define PIPE_BYTES (1 << 20)      /* the most that Linux allows every user */
#define PAUSE_NANOSECONDS 2000000 /* the pause between two checks whether the child has ended */

/* ---------------------------------------------------------------- standard error */

static void read_errors(void *user, int worker) {
  cs_child *child = user;
  char bytes[CS_WORDS];
  (void)worker;
  for (ssize_t size; (size = read(child->errors, bytes, sizeof bytes)) != 0;)
    if (size > 0)
      cs_words_add(&child->words, bytes, (size_t)size);
    else if (errno != EINTR)
      return;
}

/* ---------------------------------------------------------------- starting */

static void close_both(const int ends[2]) {
  for (int i = 0; i < 2; i++)
    if (ends[i] >= 0)
      close(ends[i]);
}

static int start_reader(cs_child *child) {
  if (cs_threads_start(&child->reader, 1, read_errors, child) == 1)
    return 0;
  kill(-child->id, SIGKILL);
  waitpid(child->id, NULL, 0);
  return EAGAIN;
}

/* The pipes of a child; -1: none. */
typedef struct pipes {
  int input[2], errors[2], samples[2];
} pipes;

static int open_pipes(pipes *out, bool has_samples) {
  *out = (pipes){{-1, -1}, {-1, -1}, {-1, -1}};
  int error = cs_spawn_pipe(out->input);
  if (error == 0)
    error = cs_spawn_pipe(out->errors);
  if (error == 0 && has_samples)
    error = cs_spawn_pipe(out->samples);
  return error;
}

static int start(cs_child *child, const char *const *arguments, pipes *p) {
  const int files[] = {p->input[0], CS_SPAWN_NULL, p->errors[1], p->samples[0]};
  const cs_spawn_desc desc = {.arguments = arguments,
                              .files = files,
                              .file_count = p->samples[0] >= 0 ? 4 : 3,
                              .bound_by = SIGKILL};
  fcntl(p->input[1], F_SETPIPE_SZ, PIPE_BYTES);
  int error = cs_spawn(&child->id, &desc);
  if (error)
    return error;
  child->input = p->input[1];
  child->errors = p->errors[0];
  child->samples = p->samples[1];
  error = start_reader(child);
  if (error == 0)
    p->input[1] = p->errors[0] = p->samples[1] = -1; /* the child's from now on */
  return error;
}

int cs_child_start(cs_child *child, const char *const *arguments, bool has_samples) {
  pipes p;
  *child = (cs_child){.samples = -1};
  int error = open_pipes(&p, has_samples);
  if (error == 0)
    error = start(child, arguments, &p);
  close_both(p.input);
  close_both(p.errors);
  close_both(p.samples);
  return error;
}

/* ---------------------------------------------------------------- its input */

int cs_child_write(int descriptor, const void *bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    ssize_t written = write(descriptor, (const char *)bytes + done, size - done);
    if (written < 0 && errno != EINTR)
      return errno;
    done += written > 0 ? (size_t)written : 0;
  }
  return 0;
}

/* ---------------------------------------------------------------- the end */

/* Whether the child has ended. Its number stays valid until somebody waits for it. */
static bool has_ended(const cs_child *child) {
  siginfo_t info = {0};
  int result = waitid(P_PID, (id_t)child->id, &info, WEXITED | WNOHANG | WNOWAIT);
  return result == 0 ? info.si_pid == child->id : errno != EINTR;
}

static bool wait_for(const cs_child *child, double seconds) {
  const struct timespec pause = {.tv_nsec = PAUSE_NANOSECONDS};
  for (double start = cs_clock_seconds(); !has_ended(child);) {
    if (cs_interrupt_signal() || cs_clock_seconds() - start >= seconds)
      return false;
    nanosleep(&pause, NULL);
  }
  return true;
}

bool cs_child_end(cs_child *child, double seconds) {
  bool is_over = wait_for(child, seconds);
  kill(-child->id, SIGKILL);
  while (waitpid(child->id, &child->ending, 0) < 0 && errno == EINTR)
    continue;
  cs_threads_join(&child->reader, 1);
  close(child->errors);
  cs_words_join(&child->words);
  return is_over;
}
