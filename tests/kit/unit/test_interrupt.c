/* process/interrupt.c: a wait ends by a signal, whenever that came. */
#include "process/interrupt.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/check.h"

/* Milliseconds, longer than a program may take to stop. */
enum { LONG = 60000 };

/* Whether a process that waits ends by itself, not by force. early: its signal comes before it
 * waits; else 50 ms after it was started. */
static bool ends_its_wait(bool early, int number) {
  pid_t process = fork();
  if (process == 0) {
    signal(number, SIG_DFL); /* nohup ignores SIGHUP, and what is ignored stays so */
    cs_interrupt_install();
    if (early)
      raise(number);
    cs_interrupt_wait(NULL, 0, LONG);
    _exit(cs_interrupt_signal() == number ? 0 : 1);
  }
  int status = -1;
  if (!early) {
    usleep(50000);
    kill(process, number);
  }
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static void signals_end_waits(void) {
  static const int numbers[] = {SIGTERM, SIGINT, SIGHUP};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    CHECK(ends_its_wait(true, numbers[i]));
}

static void waits_are_over_in_time(void) { cs_interrupt_wait(NULL, 0, 1); }

/* A program that got its signal before it was ready to handle it has ended by it. */
static void signals_during_waits_end_them(void) {
  int ends = 0;
  for (int i = 0; i < 8; i++)
    ends += ends_its_wait(false, SIGTERM);
  CHECK(ends > 0);
}

int main(void) {
  signals_end_waits();
  waits_are_over_in_time();
  signals_during_waits_end_them();
  return check_done();
}
