#include "base/program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <unistd.h>

const char *const cs_program_libraries[] = {"../lib/celspan", "../lib/x86_64-linux-gnu/celspan",
                                            "../lib/aarch64-linux-gnu/celspan", "../lib64/celspan",
                                            NULL};

const char *cs_program_path(void) {
  static const char own[] = "/proc/self/exe";
  const char *started = (const char *)getauxval(AT_EXECFN);
  return started && access(own, F_OK) != 0 ? started : own;
}

bool cs_program_folder(char *out, size_t size) {
  char *whole = realpath(cs_program_path(), NULL);
  int length = whole ? (int)(strrchr(whole, '/') - whole) : 0;
  bool is_known = whole && (size_t)snprintf(out, size, "%.*s", length, whole) < size;
  free(whole);
  return is_known;
}
