/* The common beginning of every fuzz target.
 *
 * Built with the option `fuzz`, a target is a program of clang's libFuzzer; else replay.h gives it
 * a main that runs the files given to it. A target aborts if a promise is broken: `./run fuzz`
 * keeps the bytes that caused it.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void demand(bool holds, const char *text) {
  if (holds)
    return;
  fprintf(stderr, "%s\n", text);
  abort();
}
