/* The names of layers as other programs can have them. */
#include <string.h>

#include "common/utf8.h"
#include "writers/apart/apart.h"

static bool is_unsafe(char byte) { return strchr("./,", byte); }

void cs_safe_name(const char *name, size_t most, char out[CS_APART_NAME]) {
  size_t size = cs_utf8_cut(name, most < CS_APART_NAME ? most : CS_APART_NAME - 1);
  for (size_t i = 0; i < size; i++)
    out[i] = is_unsafe(name[i]) ? '_' : name[i];
  out[size] = '\0';
}
