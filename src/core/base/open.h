/* Opening and reading files, in the way that the whole library uses. Started programs do not
 * inherit the files. No call waits for a pipe to which nobody writes. A call that a signal
 * interrupts is made again.
 */
#pragma once

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"

/* Opens a file for reading. Returns a descriptor, or -1 and errno. */
static inline int cs_open_to_read(const char *path) {
  int descriptor;
  do
    descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/* Another descriptor of an open file, which keeps the locks of the file; -1 and errno: there is
 * none. */
int cs_open_twice(int descriptor);

/* Reads `size` bytes at an offset. Returns the number of bytes, which is less than `size` only at
 * the end of the file, or -1 and errno. */
static inline ssize_t cs_open_read_at(int descriptor, void *bytes, size_t size, off_t offset) {
  size_t done = 0;
  while (done < size) {
    ssize_t got = pread(descriptor, (char *)bytes + done, size - done, offset + (off_t)done);
    if (got < 0 && errno != EINTR)
      return -1;
    if (got == 0)
      break;
    done += got > 0 ? (size_t)got : 0;
  }
  return (ssize_t)done;
}

/* Adds to a hash whether a file exists, its size and its time. A change of the file is recognised
 * by these. */
static inline void cs_open_hash(cs_hash *hash, const char *path) {
  struct stat found = {0};
  cs_hash_word(hash, stat(path, &found) == 0);
  cs_hash_word(hash, (uint64_t)found.st_size);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_sec);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_nsec);
}

/* The next entry of a folder; NULL: there is no other entry. Then errno is 0 at the end of the
 * folder; otherwise it is the error. */
static inline struct dirent *cs_open_entry(DIR *folder) {
  errno = 0;
  return readdir(folder);
}

/* Whether this errno is about the file itself: it does not exist or may not be read. Otherwise the
 * system failed, and a later attempt may succeed. */
static inline bool cs_open_is_about_file(int error) {
  return error == ENOENT || error == ENOTDIR || error == EACCES || error == EPERM ||
         error == ELOOP || error == ENAMETOOLONG || error == ENXIO || error == EISDIR;
}
