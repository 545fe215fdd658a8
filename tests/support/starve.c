/* A library to be loaded before a program (LD_PRELOAD): one allocation of the whole process fails, or
 * all from one on, whoever makes it.
 *
 *   STARVE_AT=N        the N-th allocation fails, counted from 1; 0: none
 *   STARVE_LASTING=1   and all after it
 *   STARVE_FORKED=1    in processes that were forked alone, from the fork on
 *   STARVE_COUNT=FILE  how many there were is written there at the end
 */
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* The allocator that this library stands before; declared nowhere. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long made, fail_at = -1;
static atomic_bool lasts, is_waiting; /* for a fork */

static long read_number(const char *name) {
  const char *text = getenv(name);
  return text ? atol(text) : 0;
}

static void begin(void) {
  is_waiting = false;
  made = 0;
}

__attribute__((constructor)) static void prepare(void) {
  is_waiting = read_number("STARVE_FORKED") != 0;
  if (is_waiting)
    pthread_atfork(NULL, NULL, begin);
}

static bool fails(void) {
  if (is_waiting)
    return false;
  if (fail_at < 0) {
    lasts = read_number("STARVE_LASTING") != 0;
    fail_at = read_number("STARVE_AT");
  }
  long number = ++made;
  if (fail_at == 0 || (lasts ? number < fail_at : number != fail_at))
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

__attribute__((destructor)) static void tell(void) {
  char text[32];
  const char *path = getenv("STARVE_COUNT");
  int descriptor = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
  int length = snprintf(text, sizeof text, "%ld\n", (long)made);
  if (descriptor < 0)
    return;
  if (write(descriptor, text, (size_t)length) < length)
    _exit(1);
  close(descriptor);
}
