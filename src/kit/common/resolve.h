/* Where a path leads: to which file, or, if that does not exist, to which folder.
 *
 * INVARIANT: a file that does not exist leads to the nearest existing folder above it, even if a
 * link points to the file. So the question whether a path leads out of a folder has the same answer
 * whether the file exists or not.
 */
#pragma once

#include <stdbool.h>

/* An absolute path without links, which the caller frees. NULL: errno has the reason, a path that
 * is too long, too many links, or no memory. */
char *cs_resolve_path(const char *path);
/* Whether a resolved path is this resolved folder, or lies in it or in folders inside it. */
bool cs_resolve_is_below(const char *folder, const char *resolved);
