/* See base/windows/everywhere.h. */
#pragma once

#include_next <sys/time.h>

enum { ITIMER_REAL = 0 };
typedef long suseconds_t;
struct itimerval {
  struct timeval it_interval, it_value;
};
int setitimer(int which, const struct itimerval *value, struct itimerval *before);
