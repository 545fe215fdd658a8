/* Folders that may be read, with links resolved.
 *
 *   roots of a script: its folder, --allow DIR ..., the folders of CELSPAN_PATH
 *
 * INVARIANT: a path is below a root if its target (common/resolve.h) is. So the answer does not say
 * whether a file outside the roots exists.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { CS_ROOTS_MOST = 64 };

typedef struct cs_roots {
  char *paths[CS_ROOTS_MOST]; /* resolved; owned */
  size_t count;
} cs_roots;

/* Adds a folder; "" is the current one. A folder that does not exist is ignored. false: with ENOSPC
 * in errno there are too many folders, with ENOMEM there is no memory. */
bool cs_roots_add(cs_roots *roots, const char *folder);
void cs_roots_finish(cs_roots *roots);
/* Whether the path is below one of the folders. Without memory: false, with ENOMEM in errno. */
bool cs_roots_hold(const cs_roots *roots, const char *path);
