/* The calls to the system that src/ makes and that may fail, each with a hook.
 *
 * tests/faults/calls.c makes the hooks, of which there are two kinds:
 *
 *   in a test program    the linker's --wrap puts them before every call of the objects that are
 *                        linked into it, and of nothing else; `fault_calls` is their plan
 *   in a whole program   a library that is loaded before it (LD_PRELOAD) puts them before every
 *                        call from one library into another; its plan is in the environment
 *
 * So the tested code is the code that is shipped. tests/desk/spec/faults_spec.lua checks that no
 * call is missing here.
 *
 *   CALL(type, name, failure, (parameters), (arguments))     failure: the value returned then
 *   DATA(type, name, (parameters), (arguments), size)        -1, and may do less than `size`
 *   NUMBER(name, (parameters), (arguments))                  returns an errno or 0
 *   CLOSE(name, type)                                        -1, although it has closed
 *   SYNC(name)                                               -1
 */
#pragma once

#include "tests/faults/fault.h"

#define FAULT_CALLS(CALL, DATA, NUMBER, CLOSE, SYNC)                                               \
  CALL(int, open64, -1, (const char *path, int flags, mode_t mode), (path, flags, mode))           \
  CALL(int, openat64, -1, (int folder, const char *path, int flags, mode_t mode),                  \
       (folder, path, flags, mode))                                                                \
  CALL(FILE *, fopen64, NULL, (const char *path, const char *mode), (path, mode))                  \
  CALL(FILE *, popen, NULL, (const char *command, const char *type), (command, type))              \
  CALL(DIR *, opendir, NULL, (const char *path), (path))                                           \
  CALL(struct dirent *, readdir64, NULL, (DIR * folder), (folder))                                 \
  CALL(char *, realpath, NULL, (const char *path, char *out), (path, out))                         \
  CALL(ssize_t, readlink, -1, (const char *path, char *out, size_t size), (path, out, size))       \
  CALL(int, access, -1, (const char *path, int mode), (path, mode))                                \
  CALL(int, stat64, -1, (const char *path, struct stat *out), (path, out))                         \
  CALL(int, fstat64, -1, (int descriptor, struct stat *out), (descriptor, out))                    \
  CALL(int, fstatat64, -1, (int folder, const char *path, struct stat *out, int flags),            \
       (folder, path, out, flags))                                                                 \
  CALL(off_t, lseek64, -1, (int descriptor, off_t offset, int from), (descriptor, offset, from))   \
  CALL(int, ftruncate64, -1, (int descriptor, off_t size), (descriptor, size))                     \
  CALL(int, flock, -1, (int descriptor, int how), (descriptor, how))                               \
  CALL(int, mkdir, -1, (const char *path, mode_t mode), (path, mode))                              \
  CALL(int, rename, -1, (const char *from, const char *to), (from, to))                            \
  CALL(int, link, -1, (const char *from, const char *to), (from, to))                              \
  CALL(int, remove, -1, (const char *path), (path))                                                \
  CALL(int, syncfs, -1, (int descriptor), (descriptor))                                            \
  CALL(FILE *, tmpfile64, NULL, (void), ())                                                        \
  CALL(int, unlink, -1, (const char *path), (path))                                                \
  CALL(int, unlinkat, -1, (int folder, const char *path, int flags), (folder, path, flags))        \
  CALL(int, fcntl64, -1, (int descriptor, int what, long value), (descriptor, what, value))        \
  CALL(size_t, fwrite, 0, (const void *bytes, size_t size, size_t count, FILE *stream),            \
       (bytes, size, count, stream))                                                               \
  CALL(int, fflush, EOF, (FILE * stream), (stream))                                                \
  CALL(void *, mmap64, MAP_FAILED,                                                                 \
       (void *at, size_t size, int may, int flags, int descriptor, off_t offset),                  \
       (at, size, may, flags, descriptor, offset))                                                 \
  CALL(int, memfd_create, -1, (const char *name, unsigned flags), (name, flags))                   \
  CALL(int, pipe2, -1, (int ends[2], int flags), (ends, flags))                                    \
  CALL(int, dup2, -1, (int from, int to), (from, to))                                              \
  CALL(int, execv, -1, (const char *path, char *const *arguments), (path, arguments))              \
  CALL(int, execvp, -1, (const char *name, char *const *arguments), (name, arguments))             \
  CALL(int, inotify_init1, -1, (int flags), (flags))                                               \
  CALL(int, inotify_add_watch, -1, (int queue, const char *path, unsigned events),                 \
       (queue, path, events))                                                                      \
  CALL(int, poll, -1, (struct pollfd * list, nfds_t count, int most), (list, count, most))         \
  CALL(pid_t, fork, -1, (void), ())                                                                \
  CALL(pid_t, waitpid, -1, (pid_t process, int *state, int flags), (process, state, flags))        \
  DATA(read, (int descriptor, void *bytes, size_t size), (descriptor, bytes, size), size)          \
  DATA(write, (int descriptor, const void *bytes, size_t size), (descriptor, bytes, size), size)   \
  DATA(pread64, (int descriptor, void *bytes, size_t size, off_t offset),                          \
       (descriptor, bytes, size, offset), size)                                                    \
  DATA(pwrite64, (int descriptor, const void *bytes, size_t size, off_t offset),                   \
       (descriptor, bytes, size, offset), size)                                                    \
  NUMBER(pthread_create,                                                                           \
         (pthread_t * thread, const pthread_attr_t *attributes, void *(*run)(void *), void *user), \
         (thread, attributes, run, user))                                                          \
  CLOSE(close, int)                                                                                \
  CLOSE(fclose, FILE *)                                                                            \
  SYNC(fsync)

/* The plan of the hooks in a test program. */
extern fault_plan fault_calls;
