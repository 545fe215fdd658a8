/* A library to be loaded before a program (LD_PRELOAD): one allocation of the whole process fails, or
 * all from one on, whoever makes it.
 *
 *   STARVE_AT=N        the N-th allocation fails, counted from 1; 0: none
 *   STARVE_LASTING=1   and all after it
 *   STARVE_FORKED=1    in processes that were forked alone, from the fork on
 *   STARVE_LEVEL=0     in the first program alone; 1: in those that it starts; 2: in those that these start
 *   STARVE_COUNT=FILE  how many there were is written there at the end, and how many before and after the last
 *                      module was loaded
 *
 * A run for each of the hundred thousand allocations while a library is loaded would load it as often.
 * So one run tries many:
 *
 *   STARVE_UNTIL=M     each one from the N-th to the M-th fails in a copy of the process, which is waited for:
 *
 *       allocation   N-1     N        N+1      N+2
 *       process    ---o------o--------o--------o-----
 *                             \ copy   \ copy   \ copy
 *                              x end    x end    x end
 *
 *   STARVE_ENDINGS=FILE  "N CODE" is added there for each copy: its exit code, or 128 and the signal
 *
 * Copies share the descriptors of the process and have one thread: what they say to others is heard once.
 */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define COPY_SECONDS 20 /* after which one that does not end is ended, by SIGUSR2 */
#define PAUSE_NANOSECONDS 200000

/* The allocator that this library stands before; declared nowhere. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long made, fail_at = -1, until;
static long loading, loaded;          /* of those made */
static atomic_bool lasts, is_waiting; /* for a fork */
static bool is_spared;                /* a program of another level */

static long read_number(const char *name) {
  const char *text = getenv(name);
  return text ? atol(text) : 0;
}

static void begin(void) {
  is_waiting = false;
  made = 0;
}

/* The programs that this one starts find the level one lower: '0' is followed by '/'. */
static bool is_of_level(void) {
  char *level = getenv("STARVE_LEVEL");
  if (!level)
    return true;
  char own = *level;
  --*level;
  return own == '0';
}

__attribute__((constructor)) static void prepare(void) {
  is_spared = !is_of_level();
  is_waiting = read_number("STARVE_FORKED") != 0;
  if (is_waiting)
    pthread_atfork(NULL, NULL, begin);
}

/* ---------------------------------------------------------------- copies */

/* As fork, without what the C library does then: to it the copy's thread is that of the process, which may
 * hold locks of the loader. */
static pid_t copy_process(void) { return (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0); }

/* Its exit code, or 128 and the signal. */
static int end_of(pid_t copy) {
  const struct timespec pause = {.tv_nsec = PAUSE_NANOSECONDS};
  int state = 0;
  for (long pauses = 0; waitpid(copy, &state, WNOHANG) == 0; pauses++) {
    if (pauses == COPY_SECONDS * (1000000000L / PAUSE_NANOSECONDS))
      kill(copy, SIGUSR2);
    nanosleep(&pause, NULL);
  }
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

/* Adds a line to a file; one that is not whole ends the process. */
static void write_line(const char *name, int flags, const char *line, int length) {
  int descriptor = open(name, O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666);
  if (descriptor < 0)
    return;
  if (write(descriptor, line, (size_t)length) < length)
    _exit(1);
  close(descriptor);
}

/* Returns in the copy with true, and in the process, after the end of the copy, with false. */
static bool is_copy(long number) {
  char line[64];
  int before = errno;
  pid_t copy = copy_process();
  if (copy == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    until = 0;
    fail_at = number;
    return true;
  }
  int length = snprintf(line, sizeof line, "%ld %d\n", number, copy < 0 ? -1 : end_of(copy));
  write_line(getenv("STARVE_ENDINGS"), O_APPEND, line, length);
  errno = before;
  return false;
}

/* ---------------------------------------------------------------- allocations */

static void read_plan(void) {
  lasts = read_number("STARVE_LASTING") != 0;
  until = read_number("STARVE_UNTIL");
  fail_at = read_number("STARVE_AT");
}

/* Whether the allocation of this number fails; where there are copies, this may be one from now on. */
static bool is_taken(long number) {
  if (fail_at == 0 || number < fail_at)
    return false;
  if (until > 0)
    return number <= until && is_copy(number);
  return lasts || number == fail_at;
}

static bool fails(void) {
  if (is_waiting || is_spared)
    return false;
  if (fail_at < 0)
    read_plan();
  if (!is_taken(++made))
    return false;
  errno = ENOMEM;
  return true;
}

/* From here on nothing fails: a program calls this that counts what it runs (counted.c), before it tells. */
void starve_end(void);
void starve_end(void) { fail_at = 0; }

void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }

void *calloc(size_t count, size_t size) { return fails() ? NULL : __libc_calloc(count, size); }

void *realloc(void *block, size_t size) {
  return size > 0 && fails() ? NULL : __libc_realloc(block, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size) {
  *block = fails() ? NULL : __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}

void *dlopen(const char *name, int flags) {
  void *(*own)(const char *, int);
  void *symbol = dlsym(RTLD_NEXT, "dlopen");
  memcpy(&own, &symbol, sizeof own);
  loading = made;
  void *module = own(name, flags);
  loaded = made;
  return module;
}

__attribute__((destructor)) static void tell(void) {
  char text[64];
  const char *path = getenv("STARVE_COUNT");
  int length = snprintf(text, sizeof text, "%ld %ld %ld\n", (long)made, loading, loaded);
  if (path && !is_spared)
    write_line(path, O_TRUNC, text, length);
}
