/* Signals. */
#include "cli/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>

static volatile sig_atomic_t asked_by;

static void (*volatile also)(void);

static void ask_to_stop(int number) {
  asked_by = number;
  if (also)
    also();
}

/* SA_RESETHAND makes the second signal end the program. A signal ignored by the caller (nohup, a
 * shell's background job) stays ignored. */
static void handle(int number) {
  struct sigaction before;
  if (sigaction(number, NULL, &before) == 0 && before.sa_handler == SIG_IGN)
    return;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = ask_to_stop;
  action.sa_flags = (int)SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
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
