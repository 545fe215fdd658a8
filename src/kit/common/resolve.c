#include "common/resolve.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINKS_MOST = 40 }; /* as in Linux */

/* Removes the last component of a path; false if nothing is left. */
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

/* Replaces a path by the target of the link that it names. false: the target is too long. */
static bool follow(char path[PATH_MAX], char *target) {
  size_t length = strlen(target), folder = 0;
  const char *slash = strrchr(path, '/');
  if (target[0] != '/')
    folder = slash ? (size_t)(slash - path) + 1 : 0;
  if (length == 0 || folder + length >= PATH_MAX)
    return false;
  memcpy(path + folder, target, length + 1);
  return true;
}

/* One step from a path that does not exist to a path that may exist. */
static bool step(char path[PATH_MAX], int *links) {
  char target[PATH_MAX];
  ssize_t length = readlink(path, target, sizeof target - 1);
  if (length < 0)
    return strcmp(path, ".") != 0 && cut(path);
  target[length] = '\0';
  if (++*links <= LINKS_MOST && follow(path, target))
    return true;
  errno = ELOOP;
  return false;
}

char *cs_resolve_path(const char *path) {
  char at[PATH_MAX];
  int links = 0;
  if (strlen(path) >= sizeof at - 1) {
    errno = ENAMETOOLONG;
    return NULL;
  }
  strcpy(at, path[0] ? path : ".");
  char *resolved = realpath(at, NULL);
  while (!resolved && errno != ENOMEM && step(at, &links))
    resolved = realpath(at, NULL);
  return resolved;
}

bool cs_resolve_is_below(const char *folder, const char *resolved) {
  size_t length = strlen(folder);
  if (strncmp(folder, resolved, length) != 0)
    return false;
  return resolved[length] == '/' || resolved[length] == '\0' || strcmp(folder, "/") == 0;
}
