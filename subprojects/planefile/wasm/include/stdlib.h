/* For modules: see ../libc.c. */
#pragma once
#include <stddef.h>
void *realloc(void *block, size_t size);
void free(void *block);
#define abs __builtin_abs
