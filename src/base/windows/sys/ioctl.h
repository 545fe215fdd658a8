/* See base/windows/everywhere.h. */
#pragma once

enum { TIOCGWINSZ = 1 };
struct winsize {
  unsigned short ws_row, ws_col;
};
int ioctl(int descriptor, unsigned long request, ...);
