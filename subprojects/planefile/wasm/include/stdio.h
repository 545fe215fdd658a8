/* For modules: see ../libc.c. */
#pragma once
#include <stdarg.h>
#include <stddef.h>
int snprintf(char *at, size_t size, const char *format, ...);
int vsnprintf(char *at, size_t size, const char *format, va_list arguments);
