/* plugins/isolate/strict.c and roots.c: what a process can and cannot do once it is
 * confined. Every try is made in a process of its own, before and after: one that fails before
 * proves nothing.
 */
#include "plugins/isolate/strict.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/isolate/message.h"
#include "tests/support/check.h"

static char folder[] = "/tmp/celspan-strict-XXXXXX";
static char path[4][256]; /* in/read, out/write, above, link in `in` to above */

static int can_open(const char *name, int flags) {
  int descriptor = open(name, flags, 0600);
  if (descriptor >= 0)
    close(descriptor);
  return descriptor >= 0;
}

/* ---------------------------------------------------------------- tries */

static int read_inside(void) { return can_open(path[0], O_RDONLY); }
static int write_outside_of_output(void) { return can_open(path[0], O_WRONLY); }
static int write_output(void) { return can_open(path[1], O_WRONLY | O_CREAT | O_TRUNC); }
static int read_above(void) { return can_open(path[2], O_RDONLY); }
static int read_by_link(void) { return can_open(path[3], O_RDONLY); }
static int read_passwords(void) { return can_open("/etc/passwd", O_RDONLY); }
static int read_environment(void) { return can_open("/proc/self/environ", O_RDONLY); }
static int list_above(void) { return can_open(folder, O_RDONLY | O_DIRECTORY); }
static int read_library(void) { return can_open("/usr/bin/env", O_RDONLY); }

static int make_folder_above(void) {
  char name[300];
  snprintf(name, sizeof name, "%s/made", folder);
  return mkdir(name, 0700) == 0 && rmdir(name) == 0;
}

static int rename_output(void) {
  char name[300];
  snprintf(name, sizeof name, "%s/out/renamed", folder);
  return write_output() && rename(path[1], name) == 0 && unlink(name) == 0;
}

static int run_program(void) {
  pid_t child = fork();
  int status = 1;
  if (child == 0) {
    execl("/usr/bin/true", "true", (char *)NULL);
    _exit(1);
  }
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static int open_socket(void) { return socket(AF_INET, SOCK_STREAM, 0) >= 0; }
static int open_local_socket(void) { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }
static int stop_parent(void) { return kill(getppid(), 0) == 0; }
static int look_into_parent(void) {
  return ptrace(PTRACE_SEIZE, getppid(), NULL, NULL) == 0 || errno != EPERM;
}

static void *nothing(void *user) { return user; }
static int make_thread(void) {
  pthread_t thread;
  return pthread_create(&thread, NULL, nothing, NULL) == 0 && pthread_join(thread, NULL) == 0;
}

/* ---------------------------------------------------------------- running them */

static const char *confine(void) {
  char in[256], out[256];
  cs_roots read = {.count = 0}, write = {.count = 0};
  snprintf(in, sizeof in, "%s/in", folder);
  snprintf(out, sizeof out, "%s/out", folder);
  cs_roots_add(&read, in);
  cs_roots_add(&write, out);
  const char *refusal = cs_strict_enter(&(cs_strict_rights){.read = &read, .write = &write});
  cs_roots_finish(&read);
  cs_roots_finish(&write);
  return refusal;
}

static int answer(int (*try)(void), int is_confined) {
  int status = 0;
  pid_t child = fork();
  if (child == 0)
    _exit(is_confined && confine() ? 3 : try() ? 1 : 0);
  return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void check_tries(void) {
  static int (*const allowed[])(void) = {read_inside, write_output, rename_output, read_library,
                                         make_thread};
  static int (*const refused[])(void) = {
      write_outside_of_output, read_above,       read_by_link,
      read_passwords,          read_environment, list_above,
      make_folder_above,       run_program,      open_socket,
      open_local_socket,       stop_parent,      look_into_parent};
  for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++)
    CHECK(answer(allowed[i], 1) == 1);
  for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
    CHECK(answer(refused[i], 0) == 1 || refused[i] == look_into_parent);
    CHECK(answer(refused[i], 1) == 0);
  }
}

/* ---------------------------------------------------------------- roots */

static void check_roots(void) {
  char in[256], beside[300];
  cs_roots roots = {.count = 0};
  snprintf(in, sizeof in, "%s/in", folder);
  CHECK(cs_roots_add(&roots, in));
  CHECK(cs_roots_hold(&roots, in));
  CHECK(cs_roots_hold(&roots, path[0]));
  CHECK(!cs_roots_hold(&roots, path[3])); /* a link that leads out */
  CHECK(!cs_roots_hold(&roots, folder));
  snprintf(beside, sizeof beside, "%s/in/no/such/file", folder);
  CHECK(cs_roots_hold(&roots, beside));
  snprintf(beside, sizeof beside, "%s/in/no/../../above", folder);
  CHECK(!can_open(beside, O_RDONLY)); /* there is no folder `no` */
  snprintf(beside, sizeof beside, "%s/inside", folder);
  CHECK(!cs_roots_hold(&roots, beside));
  CHECK(!cs_roots_hold(&roots, "") && !cs_roots_hold(&roots, "/"));
  for (size_t i = roots.count; i < CS_ROOTS_MOST; i++)
    CHECK(cs_roots_add(&roots, in));
  CHECK(!cs_roots_add(&roots, in));
  cs_roots_finish(&roots);
}

static void make_files(void) {
  static const char *const names[] = {"in/read", "out/write", "above", "in/link"};
  char name[256];
  CHECK(mkdtemp(folder) != NULL);
  for (int i = 0; i < 2; i++) {
    snprintf(name, sizeof name, "%s/%s", folder, i ? "out" : "in");
    CHECK(mkdir(name, 0700) == 0);
  }
  for (int i = 0; i < 4; i++)
    snprintf(path[i], sizeof path[i], "%s/%s", folder, names[i]);
  for (int i = 0; i < 3; i += 2)
    CHECK(can_open(path[i], O_WRONLY | O_CREAT));
  CHECK(symlink(path[2], path[3]) == 0);
}

static void remove_files(void) {
  char name[256];
  for (int i = 0; i < 4; i++)
    unlink(path[i]);
  for (int i = 0; i < 2; i++) {
    snprintf(name, sizeof name, "%s/%s", folder, i ? "out" : "in");
    rmdir(name);
  }
  CHECK(rmdir(folder) == 0);
}

/* A socket that always answers EAGAIN, of a process whose other side never ends. */
static void check_patience(void) {
  int ends[2], descriptor = -1;
  cs_message message;
  CHECK(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends) == 0);
  CHECK(cs_message_receive(ends[0], &message, &descriptor) == CS_MESSAGE_LATE);
  CHECK(cs_message_wait(ends[0], 0.05, &message, &descriptor) == CS_MESSAGE_OVER);
  message = (cs_message){.kind = CS_MESSAGE_END, .number = 7};
  CHECK(cs_message_send(ends[1], &message, -1));
  CHECK(cs_message_wait(ends[0], 0.05, &message, &descriptor) == CS_MESSAGE_ARRIVED);
  CHECK(message.number == 7);
  close(ends[0]);
  close(ends[1]);
}

static int tell_refusal(void) { return confine() == NULL; }

int main(void) {
  check_patience();
  make_files();
  check_roots();
  if (answer(tell_refusal, 0) == 1)
    check_tries();
  else
    check_skip("a kernel that can confine a process");
  remove_files();
  return check_done();
}
