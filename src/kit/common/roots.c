#include "common/roots.h"

#include <errno.h>
#include <stdlib.h>

#include "common/resolve.h"

bool cs_roots_add(cs_roots *roots, const char *folder) {
  char *resolved = realpath(folder[0] ? folder : ".", NULL);
  if (!resolved)
    return errno != ENOMEM;
  if (roots->count == CS_ROOTS_MOST) {
    free(resolved);
    errno = ENOSPC;
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

bool cs_roots_hold(const cs_roots *roots, const char *path) {
  char *resolved = cs_resolve_path(path);
  bool holds = false;
  for (size_t i = 0; resolved && i < roots->count && !holds; i++)
    holds = cs_resolve_is_below(roots->paths[i], resolved);
  free(resolved);
  return holds;
}
