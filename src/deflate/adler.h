/* The checksum of zlib streams (RFC 1950, 9), kept unreduced between calls. */
#ifndef CS_DEFLATE_ADLER_H
#define CS_DEFLATE_ADLER_H

#include <stddef.h>
#include <stdint.h>

enum { CS_ADLER_BASE = 65521 };

typedef struct cs_deflate_adler {
  uint64_t a, b;
} cs_deflate_adler;

/* Of nothing. */
#define CS_ADLER ((cs_deflate_adler){.a = 1})

static inline void cs_deflate_adler_reduce(cs_deflate_adler *sum) {
  sum->a %= CS_ADLER_BASE;
  sum->b %= CS_ADLER_BASE;
}

static inline uint32_t cs_deflate_adler_end(cs_deflate_adler sum) {
  cs_deflate_adler_reduce(&sum);
  return (uint32_t)(sum.b << 16 | sum.a);
}

void cs_deflate_adler_bytes(cs_deflate_adler *sum, const void *bytes, size_t size);

/* n pixels of s bytes p[0..s): a grows by n S, S the sum of the bytes; b by n s a and, since byte j
 * of pixel i counts once for itself and each byte after it, by S s n (n + 1)/2 - n sum(j p[j]).
 * Held to 2^20 pixels and reduced in time, nothing passes 2^63. */
static inline void cs_deflate_adler_run(cs_deflate_adler *sum, uint64_t pixel, uint64_t count,
                                        uint64_t size) {
  if (((sum->a | sum->b >> 24) >> 32) != 0)
    cs_deflate_adler_reduce(sum);
  sum->b += count * size * sum->a;
  if (pixel == 0)
    return;
  /* In lanes of 16 bits: bytes 0, 2, 4, 6 and bytes 1, 3, 5, 7; a product gathers its lanes, times
   * 1 or times their number, in the highest. */
  const uint64_t lanes = 0x00ff00ff00ff00ffu, ones = 0x0001000100010001u;
  uint64_t odd = pixel >> 8 & lanes, both = (pixel & lanes) + odd;
  uint64_t bytes = both * ones >> 48;
  uint64_t weighted = 2 * (both * 0x0000000100020003u >> 48) + (odd * ones >> 48);
  sum->a += count * bytes;
  sum->b += bytes * size * (count * (count + 1) / 2) - count * weighted;
}

#endif
