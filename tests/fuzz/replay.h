/* A fuzz target without a fuzzer: every file named on the command line, or in a folder named there,
 * is run whole and cut to a half. A target that defines REPLAY_FAILURES is run once more for each
 * of its allocations that check_is_drawn selects, which then fails; it has
 *
 *   fail_at       the number of the allocation that fails, 0: none
 *   allocations   how many the last run made
 */
#pragma once

#include <dirent.h>
#include <stdio.h>
#include <sys/stat.h>

#include "tests/support/check.h"

#ifndef REPLAY_FAILURES
static size_t fail_at, allocations;
#endif

/* Returns the number of runs. */
static size_t replay_bytes(const uint8_t *bytes, size_t size) {
  fail_at = 0;
  LLVMFuzzerTestOneInput(bytes, size);
  size_t count = allocations, runs = 2;
  for (size_t i = 1; i <= count; i++)
    if (check_is_drawn((int)i)) {
      fail_at = i;
      LLVMFuzzerTestOneInput(bytes, size);
      runs++;
    }
  fail_at = 0;
  LLVMFuzzerTestOneInput(bytes, size / 2);
  return runs;
}

static size_t replay_file(const char *path) {
  static uint8_t bytes[1 << 20];
  FILE *file = fopen(path, "rb");
  demand(file, path);
  size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  return replay_bytes(bytes, size);
}

static size_t replay_folder(const char *path) {
  size_t runs = 0;
  DIR *folder = opendir(path);
  demand(folder, path);
  for (struct dirent *entry; (entry = readdir(folder));) {
    char file[4096];
    snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
    if (entry->d_name[0] != '.')
      runs += replay_file(file);
  }
  closedir(folder);
  return runs;
}

int main(int count, char **arguments) {
  size_t runs = 0;
  for (int i = 1; i < count; i++) {
    struct stat found;
    demand(stat(arguments[i], &found) == 0, arguments[i]);
    runs += S_ISDIR(found.st_mode) ? replay_folder(arguments[i]) : replay_file(arguments[i]);
  }
  demand(runs > 0, "no file to replay");
  printf("%zu checks passed\n", runs);
  return 0;
}
