/* The names of layers as other programs can have them. */
#include <string.h>

#include "writers/apart/apart.h"

static bool is_unsafe(char byte) { return strchr("./,", byte); }

/* The greatest number of bytes up to `most` behind which a character of UTF-8 begins. */
static size_t cut(const char *name, size_t most) {
  size_t size = strlen(name);
  if (size <= most)
    return size;
  while (most > 0 && ((unsigned char)name[most] & 0xc0) == 0x80)
    most--;
  return most;
}

void cs_safe_name(const char *name, size_t most, char out[CS_APART_NAME]) {
  size_t size = cut(name, most < CS_APART_NAME ? most : CS_APART_NAME - 1);
  for (size_t i = 0; i < size; i++)
    out[i] = is_unsafe(name[i]) ? '_' : name[i];
  out[size] = '\0';
}
