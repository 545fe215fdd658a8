/* In WebAssembly, what its C library declares and does not have. Each call fails as in a kernel
 * without it: there are no changes of files to wait for, no processes, no timers, no clock of one
 * thread, and no memory as a file. Every caller has a way for this, or a sentence. */
#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include "base/open.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"

/* A function that fails. */
#define LACKS(name, ...)                                                                           \
  int name(__VA_ARGS__) {                                                                          \
    errno = ENOSYS;                                                                                \
    return -1;                                                                                     \
  }

LACKS(inotify_init1, int flags)
LACKS(inotify_add_watch, int queue, const char *path, uint32_t events)
LACKS(memfd_create, const char *name, unsigned flags)
LACKS(ppoll, struct pollfd *sources, nfds_t count, const struct timespec *time,
      const sigset_t *mask)
LACKS(prctl, int option, ...)
LACKS(sigaltstack, const stack_t *restrict stack, stack_t *restrict before)
LACKS(syncfs, int descriptor)
LACKS(timer_create, clockid_t clock, struct sigevent *restrict event, timer_t *restrict timer)
LACKS(timer_settime, timer_t timer, int flags, const struct itimerspec *restrict value,
      struct itimerspec *restrict before)

/* Files have no locks that another descriptor would keep, and fcntl would open a new file a second
 * time as a new one, which fails. */
int cs_open_twice(int descriptor) { return open("/dev/null", O_RDONLY); }

/* Files of node do not say when they are ready. */
int poll(struct pollfd *sources, nfds_t count, int milliseconds) {
  for (nfds_t i = 0; i < count; i++)
    sources[i].revents = 0;
  return 0;
}

int pthread_getcpuclockid(pthread_t thread, clockid_t *clock) { return ENOSYS; }
