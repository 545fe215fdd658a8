/* Numbers as Photoshop documents and colour profiles have them: the highest byte comes first. */
#pragma once

#include <stdint.h>

/* Stores a number of up to 4 bytes, and returns where it ends. */
static inline unsigned char *cs_big_endian_store(unsigned char *at, uint32_t number, int bytes) {
  for (int i = bytes; i-- > 0;)
    *at++ = (unsigned char)(number >> 8 * i);
  return at;
}
