/* Adler-32, the checksum of zlib streams (RFC 1950, 9): two sums modulo 65521, `a` of all bytes and
 * `b` of all values that `a` went through.
 *
 * INVARIANT: the sums may exceed the modulus between calls; a stays below 2^33 and b below 2^57.
 */
#ifndef CS_DEFLATE_ADLER_H
#define CS_DEFLATE_ADLER_H

#include <stddef.h>
#include <stdint.h>

enum { CS_DEFLATE_ADLER_BASE = 65521 };

typedef struct cs_deflate_adler {
  uint64_t a, b;
} cs_deflate_adler;

/* The checksum of no bytes. */
#define CS_DEFLATE_ADLER_EMPTY ((cs_deflate_adler){.a = 1})

static inline void cs_deflate_adler_reduce(cs_deflate_adler *sum) {
  sum->a %= CS_DEFLATE_ADLER_BASE;
  sum->b %= CS_DEFLATE_ADLER_BASE;
}

static inline uint32_t cs_deflate_adler_end(cs_deflate_adler sum) {
  cs_deflate_adler_reduce(&sum);
  return (uint32_t)(sum.b << 16 | sum.a);
}

void cs_deflate_adler_bytes(cs_deflate_adler *sum, const void *bytes, size_t size);

/* Adds `count` pixels of `size` bytes p[0], p[1], ... in closed form. Of the N = count * size
 * bytes, each adds its value to a; and b sums a after every byte, so b gains N times the old a, and
 * byte j of pixel i, which has s (n - i) - j bytes from itself to the end, as often its own value:
 *
 *   a += n S                                  S = sum of p[j], n = count, s = size
 *   b += n s a + S s n (n + 1) / 2 - n sum(j p[j])
 *
 * For n up to 2^20 and s up to 8 every term is below 2^56, so nothing overflows when the sums are
 * reduced once a reaches 2^32 or b 2^56. */
static inline void cs_deflate_adler_run(cs_deflate_adler *sum, uint64_t pixel, uint64_t count,
                                        uint64_t size) {
  if (((sum->a | sum->b >> 24) >> 32) != 0)
    cs_deflate_adler_reduce(sum);
  sum->b += count * size * sum->a;
  if (pixel == 0)
    return;
  /* Four lanes of 16 bits hold bytes 0, 2, 4, 6 (`even`) or 1, 3, 5, 7 (`odd`); `pairs` is their
   * sum. Multiplying by one constant a lane leaves the weighted sum of all lanes in the highest:
   * sum(j p[j]) is 2 (0, 1, 2, 3) . pairs + (1, 1, 1, 1) . odd. */
  const uint64_t lanes = 0x00ff00ff00ff00ffu, ones = 0x0001000100010001u;
  uint64_t odd = pixel >> 8 & lanes, pairs = (pixel & lanes) + odd;
  uint64_t bytes = pairs * ones >> 48;
  uint64_t weighted = 2 * (pairs * 0x0000000100020003u >> 48) + (odd * ones >> 48);
  sum->a += count * bytes;
  sum->b += bytes * size * (count * (count + 1) / 2) - count * weighted;
}

#endif
