#include "readers/layered/lzf.h"

#include <string.h>

bool cs_lzf_unpack(const unsigned char *packed, size_t size, unsigned char *out, size_t out_size) {
  size_t at = 0, done = 0;
  while (at < size) {
    size_t head = packed[at++], count = head >> 5;
    if (count == 0) {
      count = head + 1;
      if (count > size - at || count > out_size - done)
        return false;
      memcpy(out + done, packed + at, count);
      at += count;
      done += count;
      continue;
    }
    size_t needed = count == 7 ? 2 : 1;
    if (needed > size - at)
      return false;
    if (count == 7)
      count += packed[at++];
    count += 2;
    size_t back = ((head & 31) << 8 | packed[at++]) + 1;
    if (back > done || count > out_size - done)
      return false;
    for (size_t i = 0; i < count; i++, done++) /* may overlap what it writes: a repeated pattern */
      out[done] = out[done - back];
  }
  return done == out_size;
}
