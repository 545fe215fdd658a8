/* What the fuzz targets share, and with REPLAY_MAIN a main that runs the files of a folder. */
#pragma once

#include "common.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void demand(bool holds, const char *text) {
  if (holds)
    return;
  fprintf(stderr, "%s\n", text);
  abort();
}

#ifdef REPLAY_MAIN

#include <dirent.h>

static void replay(const char *path) {
  static unsigned char bytes[1 << 20];
  FILE *file = fopen(path, "rb");
  if (!CHECK(file != NULL))
    return;
  size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  CHECK(LLVMFuzzerTestOneInput(bytes, size) == 0);
}

int main(int count, char **arguments) {
  DIR *folder = count == 2 ? opendir(arguments[1]) : NULL;
  if (!CHECK(folder != NULL))
    return check_done();
  for (struct dirent *entry; (entry = readdir(folder));) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", arguments[1], entry->d_name);
    if (entry->d_name[0] != '.')
      replay(path);
  }
  closedir(folder);
  return check_done();
}

#endif
