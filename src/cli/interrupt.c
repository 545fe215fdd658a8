#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "output/temporary.h"

static volatile sig_atomic_t asked_by, is_noticed;

static void (*volatile also)(void);

/* Seconds after the first signal within which another one means the same request: timeout(1)
 * and shells send a signal to the program and then to its whole group. */
#define SAME_WISH 0.5

/* Seconds that the program has to notice that it was asked, and as many again to end in order. What
 * a script does in one call of C, a reader that waits and a finaliser cannot be asked; they are
 * given up then. Programs that check themselves while they run are many times slower. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PATIENCE 12
#define PATIENCE_NANOSECONDS 0
#else
#define PATIENCE 0
#define PATIENCE_NANOSECONDS 700000000
#endif

static struct timespec asked_at;
static timer_t deadline;
static bool has_deadline;

static double seconds_since_asked(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)(now.tv_sec - asked_at.tv_sec) + 1e-9 * (double)(now.tv_nsec - asked_at.tv_nsec);
}

/* Begins the time that is left anew. Safe in a signal handler. */
static void set_deadline(void) {
  const struct itimerspec patience = {
      .it_value = {.tv_sec = PATIENCE, .tv_nsec = PATIENCE_NANOSECONDS}};
  if (has_deadline)
    timer_settime(deadline, 0, &patience, NULL);
}

/* Ends the program by the signal. The signal waits until the handler that calls this is left. */
static void end_now(int number) {
  cs_temporary_abandon();
  signal(number, SIG_DFL);
  raise(number);
}

/* The first signal asks; a later one ends the program at once. Only functions that are safe in a
 * signal handler are called. */
static void ask_to_stop(int number) {
  if (asked_by == 0) {
    clock_gettime(CLOCK_MONOTONIC, &asked_at);
    asked_by = number;
    set_deadline();
    if (also)
      also();
  } else if (seconds_since_asked() > SAME_WISH) {
    end_now(number);
  }
}

/* The program has not ended by itself. */
static void give_up(int unused) {
  static const char message[] = "celspan: the work did not stop when a signal asked for it, and was "
                                "given up; unfinished files are removed\n";
  (void)unused;
  if (asked_by == 0)
    return;
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) {
    /* there is nobody to tell */
  }
  end_now(asked_by);
}

/* A signal ignored by the caller (nohup, a shell's background job) stays ignored; while one is
 * handled the others wait. */
static void handle(int number) {
  struct sigaction before;
  if (sigaction(number, NULL, &before) == 0 && before.sa_handler == SIG_IGN)
    return;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  sigaction(number, &action, NULL);
}

/* Where there is no timer, only the second signal ends what cannot be asked. */
static void make_deadline(void) {
  struct sigevent event;
  struct sigaction action;
  memset(&event, 0, sizeof event);
  memset(&action, 0, sizeof action);
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  action.sa_handler = give_up;
  sigfillset(&action.sa_mask);
  has_deadline = sigaction(SIGALRM, &action, NULL) == 0 &&
                 timer_create(CLOCK_MONOTONIC, &event, &deadline) == 0;
}

void cs_interrupt_install(void) {
  make_deadline();
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  handle(SIGINT);
  handle(SIGTERM);
  handle(SIGHUP);
}

/* Whoever asks ends in order from then on. */
int cs_interrupt_signal(void) {
  if (asked_by != 0 && !is_noticed) {
    is_noticed = 1;
    set_deadline();
  }
  return asked_by;
}

void cs_interrupt_call(void (*function)(void)) { also = function; }

void cs_interrupt_die(void) {
  cs_temporary_abandon();
  signal(asked_by, SIG_DFL);
  raise(asked_by);
}

bool cs_interrupt_progress(void *user, int32_t rows_done, int32_t rows_total) {
  (void)user, (void)rows_done, (void)rows_total;
  return cs_interrupt_signal() == 0;
}
