/* For modules: see ../libc.c. */
#pragma once
#include <stddef.h>
wchar_t *wmemset(wchar_t *out, wchar_t letter, size_t count);
