#include "base/wait.h"

#include <time.h>

enum { MOMENT = 100000000, SECOND = 1000000000 }; /* nanoseconds */

void cs_wait_init(pthread_cond_t *condition) {
  pthread_condattr_t monotonic;
  pthread_condattr_init(&monotonic);
  pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
  pthread_cond_init(condition, &monotonic);
  pthread_condattr_destroy(&monotonic);
}

bool cs_wait_moment(pthread_cond_t *condition, pthread_mutex_t *mutex) {
  struct timespec until;
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += MOMENT;
  until.tv_sec += until.tv_nsec / SECOND;
  until.tv_nsec %= SECOND;
  return pthread_cond_timedwait(condition, mutex, &until) == 0;
}
