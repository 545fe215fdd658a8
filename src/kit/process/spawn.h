/* Starting another program, with the files and signals that a program expects.
 *
 * It gets a process group of its own, so that Ctrl-C reaches this program only, which then ends the
 * whole group.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum { CS_SPAWN_NULL = -1, CS_SPAWN_SAME = -2, CS_SPAWN_FILES = 8 };

typedef struct cs_spawn_desc {
  const char *path;             /* NULL: found through PATH, by the first argument */
  const char *const *arguments; /* the name of the program first, NULL at the end */
  /* what becomes its descriptors 0, 1, ...: a descriptor of this process, whose number is the
   * same or beyond those of the list; /dev/null; or unchanged */
  const int *files;
  size_t file_count;
  int bound_by; /* the signal that it gets when the thread that starts it ends, for whatever reason;
                 * 0: none */
} cs_spawn_desc;

/* Opens a pipe whose ends have numbers that no file of a new process gets, even if lower ones are
 * free. Returns 0, or an errno; the ends are -1 then. */
int cs_spawn_pipe(int ends[2]);
/* Returns 0 or an errno. */
int cs_spawn(pid_t *id, const cs_spawn_desc *desc);
