/* Spec files run by busted, each in a process of its own.
 *
 *   cs_spec_run_start --fork--> child: Lua, celspan, busted, one spec file
 *        |                          | records          | what it prints
 *   cs_spec_run_collect <-----------+------------------+
 *
 * A process keeps what one spec changes from the others, and one that dies from ending the run.
 * Records are "KIND LENGTH\n" and that many bytes.
 */
#ifndef CS_CLI_SPEC_RUN_H
#define CS_CLI_SPEC_RUN_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

#include "celspan/celspan.h"

typedef struct cs_spec_run {
  const char *path;        /* borrowed */
  pid_t process;           /* 0: not running */
  FILE *records, *printed; /* owned; NULL: not started */
  size_t passed, failed, skipped;
} cs_spec_run;

/* Whether busted is to be found. */
bool cs_spec_run_has_busted(void);
/* Starts the process. only: a pattern of names, or NULL. false: reported. */
bool cs_spec_run_start(cs_spec_run *run, celspan_context *context, const char *only);
/* After the process ended with `status` of waitpid(2): counts, prints failures and what was printed,
 * and closes the files. */
void cs_spec_run_collect(cs_spec_run *run, int status);
/* Closes the files of a run that nobody collects. */
void cs_spec_run_drop(cs_spec_run *run);

#endif
