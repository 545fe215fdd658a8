/* How picture modules open what they are asked for. */
#pragma once

#include <fcntl.h>
#include <stdio.h>

#define CS_OPENED "/proc/self/fd/" /* names of open files begin with this */

/* A descriptor of the file, or -1 and errno. For the name of an open file its number is used,
 * because /proc may be missing. NONBLOCK: opening a pipe that nobody writes to must not wait. */
static inline int cs_opened_again(const char *path) {
  int number = -1;
  if (sscanf(path, CS_OPENED "%d", &number) == 1)
    return fcntl(number, F_DUPFD_CLOEXEC, 0);
  return open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}
