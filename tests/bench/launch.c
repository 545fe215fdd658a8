/* Runs a command and measures it: `launch first|all COMMAND [ARGUMENT...]`.
 *
 * Prints the wall time from the fork to the end (all), or to the first byte on its standard output
 * (first; the command is then ended), processor time, and the peak of memory. Standard output of
 * the command goes to standard error under `all`.
 *
 * The processor time is that of all processes below the command, also of those whose parents ended
 * first (a browser has such): they become children of this one, and are awaited. The peak of memory
 * is that of the largest of them.
 */
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "measure.h"

static double of(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

/* Starts the command; returns the read end of its standard output, or -1. */
static int start(char **command, bool is_piped, pid_t *child) {
  int ends[2] = {-1, -1};
  if (is_piped && pipe(ends) != 0)
    bench_stop("no pipe");
  *child = fork();
  if (*child < 0)
    bench_stop("no process");
  if (*child == 0) {
    dup2(is_piped ? ends[1] : STDERR_FILENO, STDOUT_FILENO);
    execvp(command[0], command);
    _exit(127);
  }
  if (is_piped)
    close(ends[1]);
  return ends[0];
}

int main(int argc, char **argv) {
  if (argc < 3)
    bench_stop("usage: launch first|all COMMAND [ARGUMENT...]");
  bool is_first = strcmp(argv[1], "first") == 0;
  pid_t child;
  struct rusage used;
  int status;
  char byte;
  if (prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0)
    bench_stop("orphans cannot be awaited");
  double begun = bench_wall(), spent = 0;
  int output = start(argv + 2, is_first, &child);
  if (is_first) {
    if (read(output, &byte, 1) != 1)
      bench_stop("%s wrote nothing", argv[2]);
    spent = bench_wall() - begun;
    kill(child, SIGKILL);
  }
  if (waitpid(child, &status, 0) != child)
    bench_stop("the command was lost");
  if (!is_first) {
    spent = bench_wall() - begun;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      bench_stop("%s failed", argv[2]);
  }
  while (wait(NULL) > 0)
    ;
  if (getrusage(RUSAGE_CHILDREN, &used) != 0)
    bench_stop("no account of the command");
  double processor = of(used.ru_utime) + of(used.ru_stime);
  bench_tell("wall", spent);
  bench_tell("best_wall", spent);
  bench_tell("processor", processor);
  bench_tell("best_processor", processor);
  bench_tell("runs", 1);
  bench_tell("peak_kib", (double)used.ru_maxrss);
  bench_line_end();
  return 0;
}
