/* The arguments of a program, one after the other. What does not fit is left out. */
#pragma once

#include <stddef.h>

enum { CS_ARGUMENTS_MOST = 160, CS_ARGUMENTS_TEXT = 16384 };

typedef struct cs_arguments {
  const char *list[CS_ARGUMENTS_MOST]; /* the program first, NULL at the end */
  size_t count;
  char texts[CS_ARGUMENTS_TEXT]; /* of the arguments that were formatted */
  size_t size;
} cs_arguments;

/* Adds arguments, which are borrowed. */
void cs_arguments_add(cs_arguments *out, const char *const *arguments, size_t count);
#define CS_ARGUMENTS(out, ...)                                                                     \
  cs_arguments_add(out, (const char *const[]){__VA_ARGS__},                                        \
                   sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))
/* Adds an option, or none for NULL, and a formatted value. */
void cs_arguments_value(cs_arguments *out, const char *option, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
