#include "deflate/adler.h"

#include <zlib.h>

void cs_deflate_adler_bytes(cs_deflate_adler *sum, const void *bytes, size_t size) {
  uLong joined = adler32_z(cs_deflate_adler_end(*sum), bytes, size);
  sum->a = joined & 0xffff;
  sum->b = joined >> 16;
}
