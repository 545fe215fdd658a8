/* A program that runs beside this one: bytes go into its standard input, and what it says on
 * standard error is kept for a message.
 *
 *   input --pipe--> program --standard error--> thread: the last words
 *                      `--> standard output: nowhere
 *
 * It has a process group of its own, so that Ctrl-C reaches this program alone, which then ends the
 * other one with all that it has started.
 *
 * INVARIANT: a process that was started is ended once, by cs_process_end; afterwards neither it nor
 * its group is left.
 */
#ifndef CS_CLI_VIDEO_PROCESS_H
#define CS_CLI_VIDEO_PROCESS_H

#include <sys/types.h>

#include "base/context.h"
#include "base/thread_pool.h"

enum { CS_PROCESS_WORDS = 512 };

typedef struct cs_process {
  pid_t id;
  int input; /* the caller's, to be closed before the end */
  int words; /* the program's standard error */
  cs_thread reader;
  char last[CS_PROCESS_WORDS + 1]; /* of what it said, as one line; set at the end */
  size_t last_size;
  int exit_code; /* at the end; -1: it was ended by a signal */
  int signal;
} cs_process;

/* The program is found through PATH; arguments: its name first, NULL at the end. The answer is 0 or
 * an errno. */
int cs_process_start(cs_process *process, const char *const *arguments);
/* Waits for the end, for at most `seconds`; ends the program after them, or when a signal asks this
 * one to stop: then the answer is false. seconds 0: at once. */
bool cs_process_end(cs_process *process, double seconds);
/* Writes "ended with exit code 1: its last words". */
void cs_process_describe(const cs_process *process, char *out, size_t size);

#endif
