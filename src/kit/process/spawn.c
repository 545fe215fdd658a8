#include "process/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---------------------------------------------------------------- in the new process */

/* Between fork and exec only functions that are safe in a signal handler are called: other threads
 * of this program may have held locks. */

/* Handlers of this program must not run in the new process; it ignores SIGPIPE and SIGXFSZ, which a
 * program does not expect. Ends with no signal blocked. */
static void set_signals(void) {
  struct sigaction usual = {.sa_handler = SIG_DFL}, before;
  sigset_t none;
  for (int number = 1; number < NSIG; number++)
    if (sigaction(number, NULL, &before) == 0 &&
        (before.sa_handler != SIG_IGN || number == SIGPIPE || number == SIGXFSZ))
      sigaction(number, &usual, NULL);
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
}

static bool set_file(int number, int file) {
  if (file == CS_SPAWN_SAME)
    return true;
  if (file == number)
    return fcntl(number, F_SETFD, 0) == 0;
  int opened = file == CS_SPAWN_NULL ? open("/dev/null", O_RDWR) : file;
  if (opened < 0 || (opened != number && dup2(opened, number) < 0))
    return false;
  if (file == CS_SPAWN_NULL && opened != number)
    close(opened);
  return true;
}

static bool set_files(const cs_spawn_desc *desc) {
  for (size_t i = 0; i < desc->file_count; i++)
    if (!set_file((int)i, desc->files[i]))
      return false;
  return true;
}

/* A parent that ended before the call of prctl is noticed by its number. */
static bool bind_to(pid_t parent, int signal) {
  return prctl(PR_SET_PDEATHSIG, signal) == 0 && getppid() == parent;
}

/* report: a pipe, which gets an errno if the program cannot be started. */
static _Noreturn void become(const cs_spawn_desc *desc, pid_t parent, int report) {
  setpgid(0, 0);
  set_signals();
  errno = ESRCH;
  if ((!desc->bound_by || bind_to(parent, desc->bound_by)) && set_files(desc))
    execvp(desc->path ? desc->path : desc->arguments[0], (char *const *)(size_t)desc->arguments);
  int error = errno;
  ssize_t written = write(report, &error, sizeof error);
  (void)written;
  _exit(127);
}

/* ---------------------------------------------------------------- in this process */

int cs_spawn_pipe(int ends[2]) {
  int first[2];
  ends[0] = ends[1] = -1;
  if (pipe2(first, O_CLOEXEC) != 0)
    return errno;
  for (int i = 0; i < 2; i++)
    ends[i] = fcntl(first[i], F_DUPFD_CLOEXEC, CS_SPAWN_FILES);
  int error = ends[0] < 0 || ends[1] < 0 ? errno : 0;
  for (int i = 0; i < 2; i++) {
    close(first[i]);
    if (error && ends[i] >= 0)
      close(ends[i]);
    ends[i] = error ? -1 : ends[i];
  }
  return error;
}

/* The errno of a program that could not be started; 0: it was started. */
static int wait_for_report(int report) {
  int error = 0;
  ssize_t got;
  do
    got = read(report, &error, sizeof error);
  while (got < 0 && errno == EINTR);
  return got < 0 ? errno : got == (ssize_t)sizeof error ? error : 0;
}

/* Signals are blocked, so that no handler of this program runs in the new process. */
static int start(pid_t *id, const cs_spawn_desc *desc, int report) {
  sigset_t every, before;
  pid_t self = getpid();
  sigfillset(&every);
  pthread_sigmask(SIG_SETMASK, &every, &before);
  *id = fork();
  if (*id == 0)
    become(desc, self, report);
  int error = *id < 0 ? errno : 0;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return error;
}

int cs_spawn(pid_t *id, const cs_spawn_desc *desc) {
  int report[2];
  int error = cs_spawn_pipe(report);
  if (error)
    return error;
  error = start(id, desc, report[1]);
  bool is_started = error == 0;
  close(report[1]);
  if (is_started)
    error = wait_for_report(report[0]);
  close(report[0]);
  if (is_started && error) {
    kill(*id, SIGKILL);
    while (waitpid(*id, NULL, 0) < 0 && errno == EINTR)
      continue;
  }
  return error;
}
