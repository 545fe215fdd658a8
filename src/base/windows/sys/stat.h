/* See base/windows/everywhere.h. */
#pragma once

#include_next <sys/stat.h>

#include <direct.h>
#include <stdint.h>
#include <time.h>

struct cs_lacking_stat {
  uint64_t st_dev, st_ino, st_nlink;
  int64_t st_size;
  unsigned st_mode;
  struct timespec st_mtim, st_ctim;
};

int cs_lacking_stat(const char *path, struct cs_lacking_stat *out);
int cs_lacking_fstat(int descriptor, struct cs_lacking_stat *out);
int cs_lacking_mkdir(const char *path, mode_t mode);
#undef stat
#undef fstat
#define stat cs_lacking_stat
#define fstat cs_lacking_fstat
#define mkdir cs_lacking_mkdir
int fstatat(int folder, const char *name, struct cs_lacking_stat *out, int flags);
