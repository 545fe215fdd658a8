/* Starting another program, with the files and signals that a program expects.
 *
 * It gets a process group of its own, so that Ctrl-C reaches this program only, which then ends the
 * whole group.
 */
#pragma once

#include <stddef.h>
#include <sys/types.h>

enum { CS_SPAWN_NULL = -1, CS_SPAWN_SAME = -2 };

/* arguments: its name first, found through PATH unless `path` is given, NULL at the end. files: its
 * descriptors 0, 1, ...: each a descriptor of this process, /dev/null, or unchanged. Returns 0 or
 * an errno. */
int cs_spawn(pid_t *id, const char *path, const char *const *arguments, const int *files,
             size_t file_count);
