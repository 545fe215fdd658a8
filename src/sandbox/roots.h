/* Where a script may read: folders, links resolved.
 *
 *   roots  the script's folder, --allow DIR ..., the folders of CELSPAN_PATH
 *
 * INVARIANT: a path is below a root when, with all links resolved, it begins with the resolved root
 * and a slash. What does not exist is judged by the nearest folder above it that does.
 */
#ifndef CS_SANDBOX_ROOTS_H
#define CS_SANDBOX_ROOTS_H

#include <stdbool.h>
#include <stddef.h>

enum { CS_ROOTS_MOST = 64 };

typedef struct cs_roots {
  char *paths[CS_ROOTS_MOST]; /* resolved; owned */
  size_t count;
} cs_roots;

/* Adds a folder; "" is the current one. false: there is no room, or, with ENOMEM in errno, no memory. A
 * folder that does not exist is left out. */
bool cs_roots_add(cs_roots *roots, const char *folder);
void cs_roots_finish(cs_roots *roots);
/* Whether the path is below one of them. Without memory it is not, with ENOMEM in errno. */
bool cs_roots_hold(const cs_roots *roots, const char *path);

#endif
