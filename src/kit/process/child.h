/* A child process: bytes go into its standard input, and the end of its standard error is kept for
 * a message.
 *
 *   input ----pipe--> child --standard error--> thread: its last words
 *   samples --pipe--^    `--> standard output: discarded
 *
 * INVARIANT: each child that was started is ended exactly once, by cs_child_end, together with its
 * process group. If this program is killed, the kernel kills the child.
 */
#pragma once

#include <sys/types.h>

#include "inside/context.h"
#include "inside/threads.h"
#include "process/words.h"

#define CS_CHILD_SAMPLES 3 /* the number of the second pipe in the child */

typedef struct cs_child {
  pid_t id;
  int input;   /* the caller closes it before the end */
  int samples; /* closed by the caller, too; -1: none */
  int errors;  /* the child's standard error */
  cs_thread reader;
  cs_words words; /* joined at the end */
  int ending;     /* set at the end: the status of waitpid */
} cs_child;

/* Starts a program, which is found through PATH, from a thread that ends after the child does.
 * arguments: its name first, NULL at the end. has_samples: it has a second pipe to read. Returns 0
 * or an errno. */
int cs_child_start(cs_child *process, const char *const *arguments, bool has_samples);
/* Writes all of the bytes to one of its pipes. 0, or an errno. */
int cs_child_write(int descriptor, const void *bytes, size_t size);
/* Waits at most `seconds` for the child to end. Kills it afterwards, or when a signal requests a
 * stop; then the result is false. seconds 0: kills it at once. */
bool cs_child_end(cs_child *process, double seconds);
