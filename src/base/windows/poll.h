/* See base/windows/everywhere.h: no source is ever ready. */
#pragma once

#include <signal.h>
#include <time.h>

enum { POLLIN = 1, POLLERR = 8, POLLHUP = 16 };
typedef unsigned long nfds_t;
struct pollfd {
  int fd;
  short events, revents;
};
int poll(struct pollfd *sources, nfds_t count, int milliseconds);
int ppoll(struct pollfd *sources, nfds_t count, const struct timespec *time, const sigset_t *mask);
