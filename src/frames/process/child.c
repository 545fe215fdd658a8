#include "frames/process/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "frames/process/interrupt.h"
#include "frames/process/spawn.h"

#define PIPE_BYTES (1 << 20)      /* the most that Linux allows every user */
#define PAUSE_NANOSECONDS 2000000 /* between two checks whether the child has ended */

/* ---------------------------------------------------------------- standard error */

/* size: at most CS_CHILD_ERROR. */
static void keep_last(cs_child *child, const char *bytes, size_t size) {
  size_t kept = child->last_size;
  if (kept > CS_CHILD_ERROR - size)
    kept = CS_CHILD_ERROR - size;
  memmove(child->last, child->last + child->last_size - kept, kept);
  memcpy(child->last + kept, bytes, size);
  child->last_size = kept + size;
}

static void read_errors(void *user, int worker) {
  cs_child *child = user;
  char bytes[CS_CHILD_ERROR];
  (void)worker;
  for (ssize_t size; (size = read(child->errors, bytes, sizeof bytes)) != 0;)
    if (size > 0)
      keep_last(child, bytes, (size_t)size);
    else if (errno != EINTR)
      return;
}

/* Joins all lines into one: unprintable bytes become blanks, and blanks at the ends are removed. */
static void join_lines(cs_child *child) {
  char *text = child->last;
  size_t size = 0;
  for (size_t i = 0; i < child->last_size; i++) {
    unsigned char c = (unsigned char)text[i];
    bool is_blank = c <= ' ' || c == 127;
    if (!is_blank)
      text[size++] = (char)c;
    else if (size > 0 && text[size - 1] != ' ')
      text[size++] = ' ';
  }
  child->last_size = size > 0 && text[size - 1] == ' ' ? size - 1 : size;
  text[child->last_size] = '\0';
}

/* ---------------------------------------------------------------- starting */

static int spawn(cs_child *child, const char *const *arguments, int input, int errors) {
  const int files[] = {input, CS_SPAWN_NULL, errors};
  return cs_spawn(&child->id, NULL, arguments, files, 3);
}

static void close_both(const int ends[2]) {
  close(ends[0]);
  close(ends[1]);
}

/* Opens a pipe that does not use the numbers of standard streams, even if these are closed. */
static int open_pipe(int ends[2]) {
  int first[2];
  if (pipe2(first, O_CLOEXEC) != 0)
    return errno;
  for (int i = 0; i < 2; i++)
    ends[i] = fcntl(first[i], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  int error = ends[0] < 0 || ends[1] < 0 ? errno : 0;
  close_both(first);
  if (error)
    close_both(ends);
  return error;
}

static int start_reader(cs_child *child) {
  if (cs_threads_start(&child->reader, 1, read_errors, child) == 1)
    return 0;
  kill(-child->id, SIGKILL);
  waitpid(child->id, NULL, 0);
  return EAGAIN;
}

int cs_child_start(cs_child *child, const char *const *arguments) {
  int input[2], errors[2];
  *child = (cs_child){0};
  int error = open_pipe(input);
  if (error)
    return error;
  error = open_pipe(errors);
  if (error) {
    close_both(input);
    return error;
  }
  fcntl(input[1], F_SETPIPE_SZ, PIPE_BYTES);
  child->input = input[1];
  child->errors = errors[0];
  error = spawn(child, arguments, input[0], errors[1]);
  close(input[0]);
  close(errors[1]);
  if (error == 0)
    error = start_reader(child);
  if (error) {
    close(child->input);
    close(child->errors);
  }
  return error;
}

/* ---------------------------------------------------------------- the end */

/* Whether it has ended. Its number stays valid until it is waited for. */
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
  int state = 0;
  bool is_over = wait_for(child, seconds);
  kill(-child->id, SIGKILL);
  while (waitpid(child->id, &state, 0) < 0 && errno == EINTR)
    continue;
  cs_threads_join(&child->reader, 1);
  close(child->errors);
  join_lines(child);
  child->exit_code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  child->signal = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
  return is_over;
}

void cs_child_describe(const cs_child *child, char *out, size_t size) {
  const char *colon = child->last_size > 0 ? ": " : "";
  if (child->exit_code >= 0)
    snprintf(out, size, "ended with exit code %d%s%s", child->exit_code, colon, child->last);
  else
    snprintf(out, size, "was ended by signal %d%s%s", child->signal, colon, child->last);
}
