/* The lines that ran are written to the files of a coverage build (-Db_coverage=true) when a
 * process ends by exit, and only where it may write them. These functions replace the calls by
 * which celspan ends in other ways, and let a process that confines itself write in the folder of
 * the build, too, which it could not if its files might not grow: the linker inserts them (--wrap).
 * A process that was started with such a limit writes no counts, because truncated ones would spoil
 * the others. */
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

#include "plugins/isolate/strict.h"

void __gcov_dump(void);
void __gcov_reset(void);

enum { ASKED = SIGPWR, PATIENCE = 1000 /* milliseconds */ };

_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);
int __real_kill(pid_t process, int number);
int __wrap_kill(pid_t process, int number);
int __real_raise(int number);
int __real_setrlimit64(int resource, const struct rlimit *limit);
int __wrap_setrlimit64(int resource, const struct rlimit *limit);
int __wrap_raise(int number);
const char *__real_cs_strict_enter(const cs_strict_rights *rights);
const char *__wrap_cs_strict_enter(const cs_strict_rights *rights);

static bool has_size_limit(void) {
  struct rlimit files;
  return getrlimit(RLIMIT_FSIZE, &files) == 0 && files.rlim_cur != RLIM_INFINITY;
}

void starve_end(void) __attribute__((weak)); /* from the library of starve.c, if it is loaded */

/* Libgcov does not check whether its allocations succeed. */
static void end_faults(void) {
  if (starve_end)
    starve_end();
}

/* A process without memory may crash while it writes its counts, and then come here again from its
 * signal handler. */
static void tell(void) {
  static volatile sig_atomic_t is_telling;
  if (is_telling)
    return;
  is_telling = 1;
  end_faults();
  __gcov_dump();
  __gcov_reset();
  is_telling = 0;
}

static void end_when_asked(int number) {
  (void)number;
  tell();
  __real_raise(SIGKILL);
}

/* Counts go to files below GCOV_PREFIX; no file can exist below this one. */
__attribute__((constructor)) static void begin(void) {
  if (has_size_limit())
    setenv("GCOV_PREFIX", "/dev/null", 1);
  atexit(end_faults);
  signal(ASKED, end_when_asked);
}

static bool has_ended(pid_t process) {
  siginfo_t found = {.si_pid = 0};
  return waitid(P_PID, (id_t)process, &found, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         found.si_pid == process;
}

/* A process that is killed could not write its counts, so it is first asked to end, and gets time
 * for this. */
int __wrap_kill(pid_t process, int number) {
  const struct timespec pause = {.tv_nsec = 1000000};
  if (number == SIGKILL && process > 0 && __real_kill(process, ASKED) == 0)
    for (int i = 0; i < PATIENCE && !has_ended(process); i++)
      nanosleep(&pause, NULL);
  return __real_kill(process, number);
}

void __wrap__exit(int code) {
  tell();
  __real__exit(code);
}

int __wrap_raise(int number) {
  tell();
  return __real_raise(number);
}

int __wrap_setrlimit64(int resource, const struct rlimit *limit) {
  return resource == RLIMIT_FSIZE ? 0 : __real_setrlimit64(resource, limit);
}

const char *__wrap_cs_strict_enter(const cs_strict_rights *rights) {
  cs_roots with = {.count = 0};
  cs_strict_rights more = *rights;
  if (rights->program)
    tell();
  if (rights->program || has_size_limit())
    return __real_cs_strict_enter(rights);
  bool is_good = cs_roots_add(&with, COUNTED_BUILD);
  for (size_t i = 0; rights->write && i < rights->write->count && is_good; i++)
    is_good = cs_roots_add(&with, rights->write->paths[i]);
  more.write = &with;
  const char *refusal = is_good ? __real_cs_strict_enter(&more) : "too many folders";
  cs_roots_finish(&with);
  return refusal;
}
