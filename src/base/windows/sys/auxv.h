/* See base/windows/everywhere.h. */
#pragma once

#include <stdint.h>

enum { AT_EXECFN = 31 };
uint64_t getauxval(unsigned long type);
