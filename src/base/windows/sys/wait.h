/* See base/windows/everywhere.h: there are no processes to wait for. */
#pragma once

#include <signal.h>

enum { WNOHANG = 1, WEXITED = 4, WNOWAIT = 0x1000000, P_PID = 1 };
#define WIFEXITED(status) ((status) == 0)
#define WEXITSTATUS(status) (status)
#define WIFSIGNALED(status) ((void)(status), 0)
#define WTERMSIG(status) (status)
typedef int id_t;
int waitid(int kind, id_t id, siginfo_t *out, int options);
pid_t waitpid(pid_t process, int *status, int options);
