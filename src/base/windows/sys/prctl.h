/* See base/windows/everywhere.h. */
#pragma once

enum { PR_SET_PDEATHSIG = 1, PR_SET_NAME = 15 };
int prctl(int option, ...);
