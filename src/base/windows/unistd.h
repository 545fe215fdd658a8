/* See base/windows/everywhere.h. */
#pragma once

#include_next <unistd.h>

#include <signal.h>

int unlink(const char *path) __asm__("cs_lacking_remove");

ssize_t pread(int descriptor, void *bytes, size_t size, off_t offset);
ssize_t pwrite(int descriptor, const void *bytes, size_t size, off_t offset);
int fsync(int descriptor);
int syncfs(int descriptor);
int link(const char *from, const char *to);
ssize_t readlink(const char *path, char *out, size_t size);
int unlinkat(int folder, const char *name, int flags);

enum { _SC_NPROCESSORS_ONLN = 1, _SC_PHYS_PAGES, _SC_PAGESIZE };
long sysconf(int name);

/* There is one process. */
pid_t fork(void);
pid_t getppid(void);
int setpgid(pid_t process, pid_t group);
int pipe2(int ends[2], int flags);
