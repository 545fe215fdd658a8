/* The monotonic clock. */
#pragma once

#include <time.h>

/* Seconds since a fixed moment; never goes back. */
static inline double cs_clock_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
