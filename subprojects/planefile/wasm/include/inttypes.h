/* For modules: see ../libc.c. */
#pragma once
#include <stdint.h>
#define PRIu32 "u"
