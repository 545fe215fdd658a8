#include "output/adler.h"

#include <zlib.h>

void cs_adler_bytes(cs_adler *sum, const void *bytes, size_t size) {
  uLong joined = adler32_z(cs_adler_end(*sum), bytes, size);
  sum->a = joined & 0xffff;
  sum->b = joined >> 16;
}
