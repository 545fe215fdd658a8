/* For modules: see ../libc.c. The module's own instructions copy and fill memory. */
#pragma once
#include <stddef.h>
#define memcpy __builtin_memcpy
#define memset __builtin_memset
int memcmp(const void *first, const void *second, size_t size);
size_t strlen(const char *text); /* only what writes calls it, which no module has */
