/* See base/windows/everywhere.h. */
#pragma once

#include <sys/stat.h>

enum { FTW_F, FTW_D, FTW_DP, FTW_PHYS = 1, FTW_DEPTH = 8 };
struct FTW {
  int base, level;
};
typedef int cs_lacking_visit(const char *path, const struct stat *about, int kind,
                             struct FTW *place);
int nftw(const char *folder, cs_lacking_visit *visit, int descriptors, int flags);
