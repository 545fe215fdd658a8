#include "base/self_check.h"

#include <stdio.h>
#include <stdlib.h>

void cs_self_check_failed(const char *claim, const char *file, int line) {
  fprintf(stderr, "celspan: self-check failed: %s (%s:%d)\n", claim, file, line);
  abort();
}
