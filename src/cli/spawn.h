/* Starting another program, with the files and signals that a program expects.
 *
 * It has a process group of its own, so that Ctrl-C reaches this program alone, which then ends the
 * other one.
 */
#ifndef CS_CLI_SPAWN_H
#define CS_CLI_SPAWN_H

#include <stddef.h>
#include <sys/types.h>

enum { CS_SPAWN_NULL = -1, CS_SPAWN_SAME = -2 };

/* arguments: its name first, found through PATH unless `path` is given, NULL at the end. files: what
 * its descriptors 0, 1, ... are made of: one of this process, /dev/null, or what they are here. The
 * answer is 0 or an errno. */
int cs_spawn(pid_t *id, const char *path, const char *const *arguments, const int *files,
             size_t file_count);

#endif
