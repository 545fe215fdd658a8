/* A library to load before a program (LD_PRELOAD): one allocation of the whole process fails, or
 * all from one on, whatever code makes it.
 *
 *   STARVE_AT=N        the N-th allocation fails, counted from 1; 0: none
 *   STARVE_LASTING=1   and all after it
 *   STARVE_FORKED=1    only in processes that were forked, from the fork on
 *   STARVE_LEVEL=0     only in the first program; 1: in those that it starts; 2: in those that
 *                      these start
 *   STARVE_PATH=N      the N-th path that is resolved is not, for lack of memory
 *   STARVE_COUNT=FILE  the number of allocations is written there at the end, the numbers before
 *                      and after the last module was loaded, and the number of resolved paths
 *
 * With a run for each of the hundred thousand allocations that loading a library makes, the library
 * would be loaded as often. So one run tries many:
 *
 *   STARVE_UNTIL=M     each one from the N-th to the M-th fails in a copy of the process, which is
 *                      waited for:
 *
 *       allocation   N-1     N        N+1      N+2
 *       process    ---o------o--------o--------o-----
 *                             \ copy   \ copy   \ copy
 *                              x end    x end    x end
 *
 *   STARVE_ENDINGS=FILE  "N CODE" is added there for each copy: its exit code, or 128 and the
 *                        signal
 *
 * Copies share the descriptors of the process and have one thread: their output to others arrives
 * once.
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

#define COPY_SECONDS 20 /* if a copy has not ended after this time, SIGUSR2 ends it */
#define PAUSE_NANOSECONDS 200000

/* The allocator that this library replaces; no header declares it. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long made, fail_at = -1, until;
static long loading, loaded;          /* counts of allocations */
static atomic_long resolved_paths;    /* their count */
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

/* Each program that this one starts sees a level that is lower by one: '0' is followed by '/'. */
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

/* Similar to fork, without the work of the C library: for it, the thread of the copy is the thread
 * of the process, which may hold locks of the loader. */
static pid_t copy_process(void) { return (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0); }

/* Returns the exit code of a copy, or 128 plus the signal. */
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

/* Adds a line to a file; an incomplete write ends the process. */
static void write_line(const char *name, int flags, const char *line, int length) {
  int descriptor = open(name, O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666);
  if (descriptor < 0)
    return;
  if (write(descriptor, line, (size_t)length) < length)
    _exit(1);
  close(descriptor);
}

/* Returns true in the copy, and false in the process after the copy has ended. */
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

/* Whether the allocation of this number fails. With copies, this process may be a copy from now
 * on. */
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

/* From now on nothing fails. A program that counts what it runs (counted.c) calls this before it
 * writes its counts. */
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

/* What the loader found by this name after this library. */
static void find_next(const char *name, void *function) {
  void *symbol = dlsym(RTLD_NEXT, name);
  memcpy(function, &symbol, sizeof symbol);
}

char *realpath(const char *path, char *resolved) {
  char *(*own)(const char *, char *);
  find_next("realpath", &own);
  if (is_spared || ++resolved_paths != read_number("STARVE_PATH"))
    return own(path, resolved);
  errno = ENOMEM;
  return NULL;
}

void *dlopen(const char *name, int flags) {
  void *(*own)(const char *, int);
  find_next("dlopen", &own);
  loading = made;
  void *module = own(name, flags);
  loaded = made;
  return module;
}

__attribute__((destructor)) static void tell(void) {
  char text[64];
  const char *path = getenv("STARVE_COUNT");
  int length = snprintf(text, sizeof text, "%ld %ld %ld %ld\n", (long)made, loading, loaded,
                        (long)resolved_paths);
  if (path && !is_spared)
    write_line(path, O_TRUNC, text, length);
}
