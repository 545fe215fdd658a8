/* See base/windows/everywhere.h: changes of files are not reported. */
#pragma once

#include <stdint.h>

enum {
  IN_CLOSE_WRITE = 8,
  IN_MOVED_FROM = 0x40,
  IN_MOVED_TO = 0x80,
  IN_DELETE = 0x200,
  IN_DELETE_SELF = 0x400,
  IN_NONBLOCK = 0x800,
  IN_CLOEXEC = 0x80000,
  IN_ONLYDIR = 0x1000000
};
struct inotify_event {
  int wd;
  uint32_t mask, cookie, len;
  char name[];
};
int inotify_init1(int flags);
int inotify_add_watch(int queue, const char *path, uint32_t events);
