#include "frames/process/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>

extern char **environ;

/* Resets the signals: this program ignores SIGPIPE and SIGXFSZ. */
static int set_attributes(posix_spawnattr_t *attributes) {
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  sigaddset(&usual, SIGXFSZ);
  posix_spawnattr_setsigmask(attributes, &none);
  posix_spawnattr_setsigdefault(attributes, &usual);
  posix_spawnattr_setpgroup(attributes, 0);
  return posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                                  POSIX_SPAWN_SETPGROUP);
}

static int set_files(posix_spawn_file_actions_t *actions, const int *files, size_t count) {
  int error = 0;
  for (int i = 0; i < (int)count && error == 0; i++)
    if (files[i] == CS_SPAWN_NULL)
      error = posix_spawn_file_actions_addopen(actions, i, "/dev/null", O_RDWR, 0);
    else if (files[i] != CS_SPAWN_SAME)
      error = posix_spawn_file_actions_adddup2(actions, files[i], i);
  return error;
}

int cs_spawn(pid_t *id, const char *path, const char *const *arguments, const int *files,
             size_t file_count) {
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
  int error = posix_spawnattr_init(&attributes);
  if (error)
    return error;
  error = posix_spawn_file_actions_init(&actions);
  if (error == 0) {
    error = set_attributes(&attributes);
    if (error == 0)
      error = set_files(&actions, files, file_count);
    if (error == 0)
      error = posix_spawnp(id, path ? path : arguments[0], &actions, &attributes,
                           (char *const *)(size_t)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
  }
  posix_spawnattr_destroy(&attributes);
  return error;
}
