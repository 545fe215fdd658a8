/* See base/windows/everywhere.h. */
#pragma once

enum { LOCK_EX = 2, LOCK_NB = 4 };
int flock(int descriptor, int operation);
