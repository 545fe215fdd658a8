/* A child process: bytes go into its standard input, and the end of its standard error is kept for
 * a message.
 *
 *   input --pipe--> child --standard error--> thread: the last bytes
 *                      `--> standard output: discarded
 *
 * INVARIANT: each child that was started is ended exactly once, by cs_child_end, together with its
 * process group.
 */
#pragma once

#include <sys/types.h>

#include "base/context.h"
#include "base/thread_pool.h"

enum { CS_CHILD_ERROR = 512 };

typedef struct cs_child {
  pid_t id;
  int input;  /* the caller closes it before the end */
  int errors; /* the child's standard error */
  cs_thread reader;
  char last[CS_CHILD_ERROR + 1]; /* of its standard error, as one line; set at the end */
  size_t last_size;
  int exit_code; /* set at the end; -1: a signal ended it */
  int signal;
} cs_child;

/* Starts a program, which is found through PATH. arguments: its name first, NULL at the end.
 * Returns 0 or an errno. */
int cs_child_start(cs_child *process, const char *const *arguments);
/* Waits at most `seconds` for the child to end. Kills it afterwards, or when a signal requests a
 * stop; then the result is false. seconds 0: kills it at once. */
bool cs_child_end(cs_child *process, double seconds);
/* Writes "ended with exit code 1: its last bytes". */
void cs_child_describe(const cs_child *process, char *out, size_t size);
