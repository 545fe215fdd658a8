/* The hooks of tests/faults/calls.h. With FAULTS_OF_A_PROGRAM: a library for LD_PRELOAD, whose plan
 * is
 *
 *   FAULT_AT=N          the N-th call fails, counted from 1; 0: none
 *   FAULT_LASTING=1     and all after it
 *   FAULT_ERROR=ERRNO   a number; -1: reads and writes are short
 *   FAULT_CALL=NAME     only calls of this name are counted, as calls.h spells it
 *   FAULT_COUNT=FILE    the number of calls, and the first that failed, written at the end
 *
 * Programs that the program starts have no hooks.
 */
#include "tests/faults/calls.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

fault_plan fault_calls;

static bool is_counted(const char *call) {
  return !fault_calls.only || strcmp(call, fault_calls.only) == 0;
}

static bool fails(const char *call) {
  if (fault_calls.error == FAULT_SHORT || !is_counted(call) || !fault_comes(&fault_calls, call))
    return false;
  errno = fault_calls.error;
  return true;
}

/* How many of `size` bytes are requested. */
static size_t shorten(const char *call, size_t size) {
  bool is_short = fault_calls.error == FAULT_SHORT && is_counted(call) && size > 1 &&
                  fault_comes(&fault_calls, call);
  return is_short ? (size + 1) / 2 : size;
}

/* ---------------------------------------------------------------- names */

/* hook_NAME replaces a call, real_NAME is the call itself. */
#ifdef FAULTS_OF_A_PROGRAM
#define DECLARE(type, name, parameters, arguments)                                                 \
  type hook_##name parameters __asm__(#name);                                                      \
  static type real_##name parameters {                                                             \
    static type(*found) parameters;                                                                \
    if (!found) {                                                                                  \
      void *symbol = dlsym(RTLD_NEXT, #name);                                                      \
      memcpy(&found, &symbol, sizeof symbol);                                                      \
    }                                                                                              \
    return found arguments;                                                                        \
  }
#else
#define DECLARE(type, name, parameters, arguments)                                                 \
  type hook_##name parameters __asm__("__wrap_" #name);                                            \
  type real_##name parameters __asm__("__real_" #name);
#endif

/* ---------------------------------------------------------------- hooks */

#define CALL(type, name, failure, parameters, arguments)                                           \
  DECLARE(type, name, parameters, arguments)                                                       \
  type hook_##name parameters { return fails(#name) ? failure : real_##name arguments; }

#define DATA(name, parameters, arguments, size)                                                    \
  DECLARE(ssize_t, name, parameters, arguments)                                                    \
  ssize_t hook_##name parameters {                                                                 \
    if (fails(#name))                                                                              \
      return -1;                                                                                   \
    size = shorten(#name, size);                                                                   \
    return real_##name arguments;                                                                  \
  }

#define NUMBER(name, parameters, arguments)                                                        \
  DECLARE(int, name, parameters, arguments)                                                        \
  int hook_##name parameters { return fails(#name) ? errno : real_##name arguments; }

/* A file is closed even if closing fails, and must not be closed again. */
#define CLOSE(name, type)                                                                          \
  DECLARE(int, name, (type file), (file))                                                          \
  int hook_##name(type file) {                                                                     \
    int result = real_##name(file);                                                                \
    return fails(#name) ? -1 : result;                                                             \
  }

/* Files written by a test program need not survive a crash: its renders do not wait for the
 * disk. */
#ifdef FAULTS_OF_A_PROGRAM
#define SYNC(name) CALL(int, name, -1, (int descriptor), (descriptor))
#else
#define SYNC(name)                                                                                 \
  DECLARE(int, name, (int descriptor), (descriptor))                                               \
  int hook_##name(int descriptor) {                                                                \
    errno = EBADF;                                                                                 \
    return fails(#name) || descriptor < 0 ? -1 : 0;                                                \
  }
#endif

FAULT_CALLS(CALL, DATA, NUMBER, CLOSE, SYNC)

/* ---------------------------------------------------------------- a whole program */

#ifdef FAULTS_OF_A_PROGRAM

static long number(const char *name) {
  const char *text = getenv(name);
  return text ? atol(text) : 0;
}

__attribute__((constructor)) static void read_plan(void) {
  unsetenv("LD_PRELOAD");
  fault_calls.only = getenv("FAULT_CALL");
  fault_calls.error = (int)number("FAULT_ERROR");
  fault_arm(&fault_calls, (size_t)number("FAULT_AT"), number("FAULT_LASTING") != 0);
}

/* When a program that counts what it runs ends, libgcov opens its files by this name, which the
 * sources never use: tests do not want these calls to fail. */
DECLARE(int, open, (const char *path, int flags, mode_t mode), (path, flags, mode))
int hook_open(const char *path, int flags, mode_t mode) {
  const char *ending = strrchr(path, '.');
  if (ending && strcmp(ending, ".gcda") == 0)
    fault_disarm(&fault_calls);
  return real_open(path, flags, mode);
}

__attribute__((destructor)) static void tell_count(void) {
  const char *path = getenv("FAULT_COUNT");
  char text[96];
  int length = snprintf(text, sizeof text, "%zu %s\n", (size_t)fault_calls.made,
                        fault_calls.call ? fault_calls.call : "none");
  fault_disarm(&fault_calls);
  int descriptor = path ? real_open64(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
  if (descriptor >= 0 && real_write(descriptor, text, (size_t)length) == length)
    real_close(descriptor);
}

#endif
