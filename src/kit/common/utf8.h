/* Texts in UTF-8. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* The most bytes, at most `most`, after which the text ends or a character begins. */
static inline size_t cs_utf8_cut(const char *text, size_t most) {
  size_t size = 0;
  while (size < most && text[size])
    size++;
  while (size > 0 && ((unsigned char)text[size] & 0xc0) == 0x80)
    size--;
  return size;
}

/* Stores a character, and returns the number of its bytes. */
static inline size_t cs_utf8_put(char out[4], uint32_t character) {
  size_t size = character < 0x80 ? 1 : character < 0x800 ? 2 : character < 0x10000 ? 3 : 4;
  for (size_t i = size - 1; i > 0; i--, character >>= 6)
    out[i] = (char)(0x80 | (character & 0x3f));
  out[0] = (char)(size == 1 ? character : (0xf00u >> size & 0xff) | character);
  return size;
}
