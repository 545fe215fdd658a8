/* See base/windows/everywhere.h. */
#pragma once

#include_next <signal.h>

#include <sys/types.h>

/* Those that C has not get numbers that nothing sends. */
#define SIGHUP 1
#define SIGQUIT 3
#define SIGTRAP 5
#define SIGBUS 7
#define SIGKILL 9
#define SIGSYS 12
#define SIGPIPE 13
#define SIGALRM 14
#define SIGXFSZ 25

#define SIG_BLOCK 0
#define SIG_SETMASK 2

enum { SA_RESTART = 1, SA_ONSTACK = 2, SA_NODEFER = 4, SIGEV_SIGNAL = 0 };
typedef unsigned sigset_t;
typedef struct siginfo {
  pid_t si_pid;
} siginfo_t;
typedef struct cs_lacking_stack {
  void *ss_sp;
  size_t ss_size;
} stack_t;
struct sigaction {
  void (*sa_handler)(int);
  int sa_flags;
  sigset_t sa_mask;
};
struct sigevent {
  int sigev_notify, sigev_signo;
};

int sigaction(int number, const struct sigaction *action, struct sigaction *before);
int sigaltstack(const stack_t *stack, stack_t *before);
int sigprocmask(int how, const sigset_t *set, sigset_t *before);
int sigemptyset(sigset_t *set);
int sigfillset(sigset_t *set);
int sigaddset(sigset_t *set, int number);
int sigdelset(sigset_t *set, int number);
int kill(pid_t process, int number);
