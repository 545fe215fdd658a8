/* Opening files to read them, as all of the library does: programs that are started do not inherit
 * them, a pipe to which nobody writes is not waited for, and a signal makes the call be made again.
 */
#ifndef CS_BASE_OPEN_H
#define CS_BASE_OPEN_H

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>

/* A descriptor, or -1 and errno. */
static inline int cs_open_to_read(const char *path) {
  int descriptor;
  do
    descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/* Whether this errno tells of the file: it is not there, or not to be read. Else the system failed,
 * and another time the file may well be read. */
static inline bool cs_open_tells_of_file(int error) {
  return error == ENOENT || error == ENOTDIR || error == EACCES || error == EPERM ||
         error == ELOOP || error == ENAMETOOLONG || error == ENXIO || error == EISDIR;
}

#endif
