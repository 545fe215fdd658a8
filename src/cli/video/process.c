#include "cli/video/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/spawn.h"

#define PIPE_BYTES (1 << 20)      /* as much as Linux lets anyone have */
#define PAUSE_NANOSECONDS 2000000 /* between two questions whether the program has ended */

/* ---------------------------------------------------------------- last words */

/* size: at most CS_PROCESS_WORDS. */
static void keep_last(cs_process *process, const char *bytes, size_t size) {
  size_t kept = process->last_size;
  if (kept > CS_PROCESS_WORDS - size)
    kept = CS_PROCESS_WORDS - size;
  memmove(process->last, process->last + process->last_size - kept, kept);
  memcpy(process->last + kept, bytes, size);
  process->last_size = kept + size;
}

static void read_words(void *user, int worker) {
  cs_process *process = user;
  char bytes[CS_PROCESS_WORDS];
  (void)worker;
  for (ssize_t size; (size = read(process->words, bytes, sizeof bytes)) != 0;)
    if (size > 0)
      keep_last(process, bytes, (size_t)size);
    else if (errno != EINTR)
      return;
}

/* Lines become one: what is not printable is a blank, and blanks at the ends are left off. */
static void join_lines(cs_process *process) {
  char *text = process->last;
  size_t size = 0;
  for (size_t i = 0; i < process->last_size; i++) {
    unsigned char c = (unsigned char)text[i];
    bool is_blank = c <= ' ' || c == 127;
    if (!is_blank)
      text[size++] = (char)c;
    else if (size > 0 && text[size - 1] != ' ')
      text[size++] = ' ';
  }
  process->last_size = size > 0 && text[size - 1] == ' ' ? size - 1 : size;
  text[process->last_size] = '\0';
}

/* ---------------------------------------------------------------- starting */

static int spawn(cs_process *process, const char *const *arguments, int input, int words) {
  const int files[] = {input, CS_SPAWN_NULL, words};
  return cs_spawn(&process->id, NULL, arguments, files, 3);
}

static void close_both(const int ends[2]) {
  close(ends[0]);
  close(ends[1]);
}

/* A pipe whose ends are not those of the standard streams, even where the caller closed these. */
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

static int start_reader(cs_process *process) {
  if (cs_threads_start(&process->reader, 1, read_words, process) == 1)
    return 0;
  kill(-process->id, SIGKILL);
  waitpid(process->id, NULL, 0);
  return EAGAIN;
}

int cs_process_start(cs_process *process, const char *const *arguments) {
  int input[2], words[2];
  *process = (cs_process){0};
  int error = open_pipe(input);
  if (error)
    return error;
  error = open_pipe(words);
  if (error) {
    close_both(input);
    return error;
  }
  fcntl(input[1], F_SETPIPE_SZ, PIPE_BYTES);
  process->input = input[1];
  process->words = words[0];
  error = spawn(process, arguments, input[0], words[1]);
  close(input[0]);
  close(words[1]);
  if (error == 0)
    error = start_reader(process);
  if (error) {
    close(process->input);
    close(process->words);
  }
  return error;
}

/* ---------------------------------------------------------------- the end */

/* Whether it has ended; its number stays its own until it is waited for. */
static bool has_ended(const cs_process *process) {
  siginfo_t info = {0};
  int result = waitid(P_PID, (id_t)process->id, &info, WEXITED | WNOHANG | WNOWAIT);
  return result == 0 ? info.si_pid == process->id : errno != EINTR;
}

static bool wait_for(const cs_process *process, double seconds) {
  const struct timespec pause = {.tv_nsec = PAUSE_NANOSECONDS};
  for (double start = cs_progress_clock(); !has_ended(process);) {
    if (cs_interrupt_signal() || cs_progress_clock() - start >= seconds)
      return false;
    nanosleep(&pause, NULL);
  }
  return true;
}

bool cs_process_end(cs_process *process, double seconds) {
  int state = 0;
  bool is_over = wait_for(process, seconds);
  kill(-process->id, SIGKILL);
  while (waitpid(process->id, &state, 0) < 0 && errno == EINTR)
    continue;
  cs_threads_join(&process->reader, 1);
  close(process->words);
  join_lines(process);
  process->exit_code = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  process->signal = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
  return is_over;
}

void cs_process_describe(const cs_process *process, char *out, size_t size) {
  const char *colon = process->last_size > 0 ? ": " : "";
  if (process->exit_code >= 0)
    snprintf(out, size, "ended with exit code %d%s%s", process->exit_code, colon, process->last);
  else
    snprintf(out, size, "was ended by signal %d%s%s", process->signal, colon, process->last);
}
