#include "process/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/files.h"

bool cs_journal_make_folders(char *path) {
  for (char *slash = path; (slash = strchr(slash + 1, '/'));) {
    *slash = '\0';
    int result = mkdir(path, 0777);
    *slash = '/';
    if (result != 0 && errno != EEXIST)
      return false;
  }
  return true;
}

bool cs_journal_make_folders_for(const char *path) {
  char copy[4096];
  size_t size = strlen(path) + 1;
  if (size > sizeof copy) {
    errno = ENAMETOOLONG;
    return false;
  }
  memcpy(copy, path, size);
  return cs_journal_make_folders(copy);
}

int cs_journal_open(const char *path) {
  return open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
}

bool cs_journal_add(int descriptor, const char *text) {
  for (size_t left = strlen(text); left > 0;) {
    ssize_t written = write(descriptor, text, left);
    if (written < 0 && errno != EINTR)
      return false;
    text += written > 0 ? written : 0;
    left -= written > 0 ? (size_t)written : 0;
  }
  return true;
}

bool cs_journal_end_last(int descriptor) {
  char last = '\0';
  off_t size = lseek(descriptor, 0, SEEK_END);
  bool is_ended = cs_open_read_at(descriptor, &last, 1, size - 1) == 1 && last == '\n';
  return is_ended || cs_journal_add(descriptor, "\n");
}
