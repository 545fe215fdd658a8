#include "program/film/output.h"

#include <string.h>

bool cs_output_lists(const char *list, const char *word) {
  const size_t size = strlen(word);
  for (const char *at = size ? strstr(list, word) : NULL; at; at = strstr(at + 1, word))
    if (at > list && at[-1] == ' ' && (at[size] == ' ' || at[size] == ','))
      return true;
  return false;
}
