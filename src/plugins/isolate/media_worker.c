#include "plugins/isolate/media_worker.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "plugins/isolate/media_arguments.h"

enum { MEDIA = 3 };

/* ---------------------------------------------------------------- the program */

/* The path of a program, with links resolved, because the kernel's rules need this. false: there is
 * none. */
static bool find_program(const char *name, char out[PATH_MAX]) {
  const char *folders = getenv("PATH");
  char path[PATH_MAX];
  while (folders) {
    const char *end = strchr(folders, ':');
    int length = (int)(end ? end - folders : (ptrdiff_t)strlen(folders));
    int size = snprintf(path, sizeof path, "%.*s%s%s", length, folders, length ? "/" : "", name);
    if (size > 0 && size < (int)sizeof path && access(path, X_OK) == 0 && realpath(path, out))
      return true;
    folders = end ? end + 1 : NULL;
  }
  return false;
}

/* ---------------------------------------------------------------- its files */

/* The file is the descriptor of the request. */
static cs_message receive(const cs_worker_desc *desc, int *file) {
  cs_message message;
  cs_message_arrival arrival;
  do
    arrival = cs_message_receive(desc->socket, &message, file);
  while (arrival == CS_MESSAGE_LATE);
  if (arrival != CS_MESSAGE_ARRIVED || message.kind != CS_MESSAGE_OPEN || *file < 0)
    _exit(0);
  return message;
}

/* Each descriptor has its source, a number from 3 on. The file is moved last, because its number
 * may be one of sources that are no longer needed then. */
static void set_files(const cs_worker_desc *desc, int file) {
  bool is_set = dup2(desc->memory, STDOUT_FILENO) >= 0 && dup2(desc->socket, STDERR_FILENO) >= 0;
  is_set = is_set && (file == MEDIA ? fcntl(file, F_SETFD, 0) == 0 : dup2(file, MEDIA) >= 0);
  if (!is_set)
    _exit(CS_MEDIA_WORKER_NOT_STARTED);
}

/* ---------------------------------------------------------------- the worker */

void cs_media_worker_run(const cs_worker_desc *desc) {
  const cs_worker_task task = (cs_worker_task)desc->start.task;
  char path[PATH_MAX];
  cs_media_arguments arguments;
  int file = -1;
  setpgid(0, 0);
  const cs_message message = receive(desc, &file);
  cs_media_arguments_make(task, &message, CS_MEDIA_WORKER_FILE, &arguments);
  if (!find_program(arguments.list[0], path))
    _exit(CS_MEDIA_WORKER_MISSING);
  set_files(desc, file);
  cs_worker_loop_confine(desc, &(cs_strict_rights){.program = path, .file = CS_MEDIA_WORKER_FILE});
  execv(path, (char *const *)(size_t)arguments.list);
  dprintf(STDERR_FILENO, "%s cannot be started: %s", path, strerror(errno));
  _exit(CS_MEDIA_WORKER_NOT_STARTED);
}
