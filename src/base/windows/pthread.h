/* See base/windows/everywhere.h. */
#pragma once

#include_next <pthread.h>

#include <signal.h>

#undef pthread_sigmask
#undef pthread_getcpuclockid
#define pthread_getcpuclockid cs_lacking_getcpuclockid
static inline int pthread_sigmask(int how, const sigset_t *set, sigset_t *before) {
  return sigprocmask(how, set, before);
}
int pthread_getcpuclockid(pthread_t thread, clockid_t *clock);
