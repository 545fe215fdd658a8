/* Where a text of UTF-8 may be cut. */
#pragma once

#include <stddef.h>

/* The most bytes, at most `most`, after which the text ends or a character begins. */
static inline size_t cs_utf8_cut(const char *text, size_t most) {
  size_t size = 0;
  while (size < most && text[size])
    size++;
  while (size > 0 && ((unsigned char)text[size] & 0xc0) == 0x80)
    size--;
  return size;
}
