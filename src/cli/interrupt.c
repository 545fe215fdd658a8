#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

static volatile sig_atomic_t asked_by;

static void (*volatile also)(void);

/* Seconds after the first signal within which another one means the same request: timeout(1)
 * and shells send a signal to the program and then to its whole group. */
#define SAME_WISH 0.5

static struct timespec asked_at;

static double seconds_since_asked(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)(now.tv_sec - asked_at.tv_sec) + 1e-9 * (double)(now.tv_nsec - asked_at.tv_nsec);
}

/* The first signal asks; a later one ends the program at once. Only functions that are safe in a
 * signal handler are called. */
static void ask_to_stop(int number) {
  if (asked_by == 0) {
    clock_gettime(CLOCK_MONOTONIC, &asked_at);
    asked_by = number;
    if (also)
      also();
  } else if (seconds_since_asked() > SAME_WISH) {
    signal(number, SIG_DFL);
    raise(number);
  }
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

void cs_interrupt_install(void) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  handle(SIGINT);
  handle(SIGTERM);
  handle(SIGHUP);
}

int cs_interrupt_signal(void) { return asked_by; }

void cs_interrupt_call(void (*function)(void)) { also = function; }

void cs_interrupt_die(void) {
  signal(asked_by, SIG_DFL);
  raise(asked_by);
}

bool cs_interrupt_progress(void *user, int32_t rows_done, int32_t rows_total) {
  (void)user, (void)rows_done, (void)rows_total;
  return asked_by == 0;
}
