/* See base/windows/everywhere.h. */
#pragma once

#include_next <fcntl.h>

#include <sys/types.h>

#define O_CLOEXEC _O_NOINHERIT
#define O_NONBLOCK 0
#define O_NOFOLLOW 0
#define O_DIRECTORY 0
#define O_NOCTTY 0

enum { AT_FDCWD = -100, AT_SYMLINK_NOFOLLOW = 0 };
int open(const char *path, int flags, ...) __asm__("cs_lacking_open");
int openat(int folder, const char *name, int flags, ...);

enum { F_GETFD = 1, F_SETFD, F_SETFL, F_DUPFD_CLOEXEC, F_ADD_SEALS, F_SETPIPE_SZ };
enum { F_SEAL_SHRINK = 2, F_SEAL_GROW = 4, F_SEAL_SEAL = 1 };
int fcntl(int descriptor, int command, ...);
