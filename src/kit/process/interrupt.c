#include "process/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "inside/files.h"

static volatile sig_atomic_t requested_by, is_noticed;

static void (*volatile on_request)(void);

/* Seconds after the first signal within which another one is the same request: timeout(1) and
 * shells send a signal to the program and then to its whole group. */
#define SAME_REQUEST 0.5

/* Seconds until the program must notice the request, and the same time again to stop cleanly. A
 * script inside one call of C, a reader that waits and a finaliser cannot notice it; the program is
 * killed then. Sanitizers make programs many times slower. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PATIENCE 12
#define PATIENCE_NANOSECONDS 0
#else
#define PATIENCE 0
#define PATIENCE_NANOSECONDS 700000000
#endif

static const int requests[] = {SIGINT, SIGTERM, SIGHUP};
enum { REQUESTS = sizeof requests / sizeof *requests };

static struct timespec requested_at;
static timer_t deadline;
static bool has_deadline;

static double seconds_since_request(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)(now.tv_sec - requested_at.tv_sec) +
         1e-9 * (double)(now.tv_nsec - requested_at.tv_nsec);
}

/* Restarts the time that is left. Safe in a signal handler. */
static void set_deadline(void) {
  const struct itimerspec patience = {
      .it_value = {.tv_sec = PATIENCE, .tv_nsec = PATIENCE_NANOSECONDS}};
  if (has_deadline)
    timer_settime(deadline, 0, &patience, NULL);
}

/* Ends the program by the signal, which is delivered when the calling handler returns. */
static void end_now(int number) {
  cs_temporary_abandon();
  signal(number, SIG_DFL);
  raise(number);
}

/* The first signal requests a stop; a later one ends the program at once. Only functions that are
 * safe in a signal handler are called. */
static void request_stop(int number) {
  if (requested_by == 0) {
    clock_gettime(CLOCK_MONOTONIC, &requested_at);
    requested_by = number;
    set_deadline();
    if (on_request)
      on_request();
  } else if (seconds_since_request() > SAME_REQUEST) {
    end_now(number);
  }
}

/* The program did not stop in time. */
static void kill_self(int unused) {
  static const char message[] =
      "celspan: the work did not stop in time after a signal and was killed; "
      "unfinished files are removed\n";
  (void)unused;
  if (requested_by == 0)
    return;
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) {
    /* nothing can be done */
  }
  end_now(requested_by);
}

/* A signal that the caller ignores (nohup, a background job of a shell) stays ignored. While one
 * signal is handled, the others are blocked. */
static void handle(int number) {
  struct sigaction before;
  if (sigaction(number, NULL, &before) == 0 && before.sa_handler == SIG_IGN)
    return;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  sigaction(number, &action, NULL);
}

/* Without a timer, only the second signal ends work that cannot notice the first. */
static void make_deadline(void) {
  struct sigevent event;
  struct sigaction action;
  memset(&event, 0, sizeof event);
  memset(&action, 0, sizeof action);
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  action.sa_handler = kill_self;
  sigfillset(&action.sa_mask);
  has_deadline = sigaction(SIGALRM, &action, NULL) == 0 &&
                 timer_create(CLOCK_MONOTONIC, &event, &deadline) == 0;
}

void cs_interrupt_install(void) {
  make_deadline();
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  for (size_t i = 0; i < REQUESTS; i++)
    handle(requests[i]);
}

/* A caller that gets a signal starts a clean stop. */
int cs_interrupt_signal(void) {
  if (requested_by != 0 && !is_noticed) {
    is_noticed = 1;
    set_deadline();
  }
  return requested_by;
}

/* No signal may arrive between the question whether there was one and the wait, because the wait
 * would not end by it: ppoll unblocks signals and waits in one step. */
void cs_interrupt_wait(struct pollfd *sources, size_t count, int milliseconds) {
  const struct timespec time = {.tv_sec = milliseconds / 1000,
                                .tv_nsec = milliseconds % 1000 * 1000000L};
  sigset_t stops, before;
  sigemptyset(&stops);
  for (size_t i = 0; i < REQUESTS; i++)
    sigaddset(&stops, requests[i]);
  pthread_sigmask(SIG_BLOCK, &stops, &before);
  if (cs_interrupt_signal() == 0)
    ppoll(sources, count, milliseconds < 0 ? NULL : &time, &before);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void cs_interrupt_call(void (*function)(void)) { on_request = function; }

void cs_interrupt_die(void) {
  cs_temporary_abandon();
  signal(requested_by, SIG_DFL);
  raise(requested_by);
}

bool cs_interrupt_progress(void *user, int32_t rows_done, int32_t rows_total) {
  (void)user, (void)rows_done, (void)rows_total;
  return cs_interrupt_signal() == 0;
}
