#include "output/sinks/temporary.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define TAIL ".part"

enum {
  NAME_SIZE = 512,
  NAME_BYTES = 200,   /* bytes of NAME in the temporary name, which may have at most 255 bytes */
  DESCRIPTORS = 4096, /* the most descriptors of a process that is ended */
  DIGITS = 4,
  TAIL_SIZE = 1 + DIGITS + sizeof TAIL - 1 /* ".12ef.part" */
};

void cs_temporary_name(const char *path, unsigned number, char *out, size_t size) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  snprintf(out, size, "%.*s.%.*s.%04x" TAIL, (int)(name - path), path, NAME_BYTES, name,
           number & 0xffff);
}

/* If the file system has no locks, other processes cannot lock the file either, so it is safe. */
bool cs_temporary_claim(int descriptor) {
  struct stat there;
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return errno != EWOULDBLOCK;
  return fstat(descriptor, &there) != 0 || there.st_nlink > 0;
}

/* The name that a temporary file will get; false if `temporary` is not the name of a temporary
 * file. */
static bool final_name(const char *temporary, char name[NAME_SIZE]) {
  size_t length = strlen(temporary);
  if (temporary[0] != '.' || length <= TAIL_SIZE + 1 || length >= NAME_SIZE)
    return false;
  const char *tail = temporary + length - TAIL_SIZE;
  if (tail[0] != '.' || strcmp(tail + 1 + DIGITS, TAIL) != 0)
    return false;
  for (int i = 1; i <= DIGITS; i++)
    if (!isxdigit((unsigned char)tail[i]))
      return false;
  memcpy(name, temporary + 1, length - 1 - TAIL_SIZE);
  name[length - 1 - TAIL_SIZE] = '\0';
  return true;
}

/* Whether the open file still has that name: its writer may have finished meanwhile, and another
 * one may have begun under the same name. */
static bool is_named(int descriptor, int folder, const char *temporary) {
  struct stat opened, named;
  return fstat(descriptor, &opened) == 0 &&
         fstatat(folder, temporary, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void cs_temporary_drop(int descriptor, const char *path) {
  if (is_named(descriptor, AT_FDCWD, path))
    unlink(path);
}

static void sweep(int folder, const char *temporary) {
  int descriptor = openat(folder, temporary, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_named(descriptor, folder, temporary))
    unlinkat(folder, temporary, 0);
  close(descriptor);
}

void cs_temporary_sweep(const char *pattern,
                        bool (*matches)(const char *pattern, const char *name)) {
  char path[4096], name[NAME_SIZE];
  const char *slash = strrchr(pattern, '/');
  const char *base = slash ? slash + 1 : pattern;
  int length = snprintf(path, sizeof path, "%.*s.", (int)(base - pattern), pattern);
  DIR *folder = length < (int)sizeof path ? opendir(path) : NULL;
  if (!folder)
    return;
  for (struct dirent *entry; (entry = readdir(folder));)
    if (final_name(entry->d_name, name) && matches(base, name))
      sweep(dirfd(folder), entry->d_name);
  closedir(folder);
}

/* ---------------------------------------------------------------- ending */

/* Writes "/proc/self/fd/N" without functions that allocate or lock. */
static void name_descriptor(int descriptor, char out[32]) {
  static const char folder[] = "/proc/self/fd/";
  char digits[12];
  size_t count = 0, length = sizeof folder - 1;
  memcpy(out, folder, length);
  do
    digits[count++] = (char)('0' + descriptor % 10);
  while ((descriptor /= 10) > 0);
  while (count > 0)
    out[length++] = digits[--count];
  out[length] = '\0';
}

/* The system knows the names of open files, so no list is needed. There, a file that has got its
 * final name, or was removed, has another name. */
void cs_temporary_abandon(void) {
  char link[32], path[4096], name[NAME_SIZE];
  for (int descriptor = 3; descriptor < DESCRIPTORS; descriptor++) {
    name_descriptor(descriptor, link);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length <= 0)
      continue;
    path[length] = '\0';
    const char *slash = strrchr(path, '/');
    if (slash && final_name(slash + 1, name))
      unlink(path);
  }
}
