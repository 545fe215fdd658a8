#include "plugins/isolate/roots.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

bool cs_roots_add(cs_roots *roots, const char *folder) {
  char *resolved = realpath(folder[0] ? folder : ".", NULL);
  if (!resolved)
    return errno != ENOMEM;
  if (roots->count == CS_ROOTS_MOST) {
    free(resolved);
    return false;
  }
  roots->paths[roots->count++] = resolved;
  return true;
}

void cs_roots_finish(cs_roots *roots) {
  for (size_t i = 0; i < roots->count; i++)
    free(roots->paths[i]);
  roots->count = 0;
}

static bool is_below(const char *root, const char *resolved) {
  size_t length = strlen(root);
  if (strncmp(root, resolved, length) != 0)
    return false;
  return resolved[length] == '/' || resolved[length] == '\0' || strcmp(root, "/") == 0;
}

/* Removes the last component; false when nothing is left. */
static bool cut(char *path) {
  char *slash = strrchr(path, '/');
  if (!slash) {
    strcpy(path, ".");
    return true;
  }
  if (slash == path && path[1] == '\0')
    return false;
  slash[slash == path] = '\0';
  return true;
}

/* The resolved path of the nearest existing folder, which the caller frees. NULL: the path is too
 * long, or there is no memory to follow its links. */
static char *resolve(const char *path) {
  char above[PATH_MAX];
  if (strlen(path) >= sizeof above - 1)
    return NULL;
  strcpy(above, path[0] ? path : ".");
  char *resolved = realpath(above, NULL);
  while (!resolved && errno != ENOMEM && strcmp(above, ".") != 0 && cut(above))
    resolved = realpath(above, NULL);
  return resolved;
}

bool cs_roots_hold(const cs_roots *roots, const char *path) {
  char *resolved = resolve(path);
  bool holds = false;
  for (size_t i = 0; resolved && i < roots->count && !holds; i++)
    holds = is_below(roots->paths[i], resolved);
  free(resolved);
  return holds;
}
