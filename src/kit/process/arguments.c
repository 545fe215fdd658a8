#include "process/arguments.h"

#include <stdarg.h>
#include <stdio.h>

void cs_arguments_add(cs_arguments *out, const char *const *arguments, size_t count) {
  for (size_t i = 0; i < count && out->count + 1 < CS_ARGUMENTS_MOST; i++)
    out->list[out->count++] = arguments[i];
}

void cs_arguments_value(cs_arguments *out, const char *option, const char *format, ...) {
  char *text = out->texts + out->size;
  size_t room = sizeof out->texts - out->size;
  va_list values;
  va_start(values, format);
  int size = vsnprintf(text, room, format, values);
  va_end(values);
  if (size < 0 || (size_t)size >= room)
    return;
  out->size += (size_t)size + 1;
  if (option)
    CS_ARGUMENTS(out, option);
  CS_ARGUMENTS(out, text);
}
