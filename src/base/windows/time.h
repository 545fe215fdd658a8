/* See base/windows/everywhere.h. */
#pragma once

#include_next <time.h>

#include <sys/types.h>

struct sigevent;
typedef int timer_t;
int timer_create(int clock, struct sigevent *event, timer_t *timer);
int timer_settime(timer_t timer, int flags, const struct itimerspec *value,
                  struct itimerspec *before);
