#include "cli/lines.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool cs_lines_make_folders(char *path) {
  for (char *slash = path; (slash = strchr(slash + 1, '/'));) {
    *slash = '\0';
    int result = mkdir(path, 0777);
    *slash = '/';
    if (result != 0 && errno != EEXIST)
      return false;
  }
  return true;
}

bool cs_lines_make_folders_for(const char *path) {
  char copy[4096];
  size_t size = strlen(path) + 1;
  if (size > sizeof copy) {
    errno = ENAMETOOLONG;
    return false;
  }
  memcpy(copy, path, size);
  return cs_lines_make_folders(copy);
}

int cs_lines_open(const char *path) {
  return open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
}

bool cs_lines_add(int descriptor, const char *text) {
  size_t size = strlen(text);
  ssize_t written = write(descriptor, text, size);
  if (written >= 0 && (size_t)written != size)
    errno = ENOSPC;
  return written == (ssize_t)size;
}

bool cs_lines_end_last(int descriptor) {
  char last = '\0';
  off_t size = lseek(descriptor, 0, SEEK_END);
  bool is_ended = pread(descriptor, &last, 1, size - 1) == 1 && last == '\n';
  return is_ended || cs_lines_add(descriptor, "\n");
}
