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

static int lacks(void) {
  errno = ENOSYS;
  return -1;
}

/* Files have no locks that another descriptor would keep, and fcntl would open a new file a second
 * time as a new one, which fails. */
int cs_open_twice(int descriptor) {
  (void)descriptor;
  return open("/dev/null", O_RDONLY);
}

int inotify_init1(int flags) {
  (void)flags;
  return lacks();
}

int inotify_add_watch(int queue, const char *path, uint32_t events) {
  (void)queue, (void)path, (void)events;
  return lacks();
}

int memfd_create(const char *name, unsigned flags) {
  (void)name, (void)flags;
  return lacks();
}

/* Files of node do not say when they are ready. */
int poll(struct pollfd *sources, nfds_t count, int milliseconds) {
  (void)milliseconds;
  for (nfds_t i = 0; i < count; i++)
    sources[i].revents = 0;
  return 0;
}

int ppoll(struct pollfd *sources, nfds_t count, const struct timespec *time, const sigset_t *mask) {
  (void)sources, (void)count, (void)time, (void)mask;
  return lacks();
}

int prctl(int option, ...) {
  (void)option;
  return lacks();
}

int pthread_getcpuclockid(pthread_t thread, clockid_t *clock) {
  (void)thread, (void)clock;
  return ENOSYS;
}

int sigaltstack(const stack_t *restrict stack, stack_t *restrict before) {
  (void)stack, (void)before;
  return lacks();
}

int syncfs(int descriptor) {
  (void)descriptor;
  return lacks();
}

int timer_create(clockid_t clock, struct sigevent *restrict event, timer_t *restrict timer) {
  (void)clock, (void)event, (void)timer;
  return lacks();
}

int timer_settime(timer_t timer, int flags, const struct itimerspec *restrict value,
                  struct itimerspec *restrict before) {
  (void)timer, (void)flags, (void)value, (void)before;
  return lacks();
}
