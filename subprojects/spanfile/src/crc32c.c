/* By the processor's instruction where it has one; else by tables. The sum is linear: that of a
 * word is the exclusive or of the sums of its eight nibbles, each in its place.
 *
 *   word       | 7 | 6 | 5 | 4 | 3 | 2 | 1 | 0 |      nibbles, 4 bits each
 *   sum        = sums_of[7][nibble 7] ^ ... ^ sums_of[0][nibble 0]
 */
#include "crc32c.h"

/* The sums of a nibble from those of its bits. */
#define HALF(from, a, b) (from), (from) ^ (a), (from) ^ (b), (from) ^ (a) ^ (b)
#define SUMS(a, b, c, d)                                                                           \
  { HALF(0u, a, b), HALF(c, a, b), HALF(d, a, b), HALF((c) ^ (d), a, b) }

static const uint32_t sums_of[8][16] = {
    SUMS(0xdd45aab8, 0xbf672381, 0x7b2231f3, 0xf64463e6),
    SUMS(0xe964b13d, 0xd725148b, 0xaba65fe7, 0x52a0c93f),
    SUMS(0xa541927e, 0x4f6f520d, 0x9edea41a, 0x38513ec5),
    SUMS(0x70a27d8a, 0xe144fb14, 0xc76580d9, 0x8b277743),
    SUMS(0x13a29877, 0x274530ee, 0x4e8a61dc, 0x9d14c3b8),
    SUMS(0x3fc5f181, 0x7f8be302, 0xff17c604, 0xfbc3faf9),
    SUMS(0xf26b8303, 0xe13b70f7, 0xc79a971f, 0x8ad958cf),
    SUMS(0x105ec76f, 0x20bd8ede, 0x417b1dbc, 0x82f63b78),
};

static uint32_t after_word(uint32_t word) {
  uint32_t sum = 0;
  for (int nibble = 0; nibble < 8; nibble++)
    sum ^= sums_of[nibble][word >> 4 * nibble & 15];
  return sum;
}

/* A single byte is treated as the last byte of a word. */
static uint32_t after_byte(uint32_t sum, unsigned char byte) {
  uint32_t low = (sum ^ byte) & 0xff;
  return sum >> 8 ^ sums_of[6][low & 15] ^ sums_of[7][low >> 4];
}

static uint32_t sum_by_tables(uint32_t sum, const unsigned char *bytes, size_t size) {
  for (; size >= 4; size -= 4, bytes += 4)
    sum = after_word(sum ^ sf_load_32(bytes));
  for (; size > 0; size--, bytes++)
    sum = after_byte(sum, *bytes);
  return sum;
}

#if defined(__x86_64__) && defined(__GNUC__)

#include <nmmintrin.h>

__attribute__((target("sse4.2"))) static uint32_t
sum_by_instruction(uint32_t sum, const unsigned char *bytes, size_t size) {
  for (; size >= 8; size -= 8, bytes += 8) {
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    sum = (uint32_t)_mm_crc32_u64(sum, word);
  }
  for (; size > 0; size--, bytes++)
    sum = _mm_crc32_u8(sum, *bytes);
  return sum;
}

static bool has_instruction(void) { return __builtin_cpu_supports("sse4.2"); }

#else

static uint32_t sum_by_instruction(uint32_t sum, const unsigned char *bytes, size_t size) {
  return sum_by_tables(sum, bytes, size);
}
static bool has_instruction(void) { return false; }

#endif

uint32_t sf_crc32c_by_tables(uint32_t sum, const void *bytes, size_t size) {
  return ~sum_by_tables(~sum, bytes, size);
}

uint32_t sf_crc32c(uint32_t sum, const void *bytes, size_t size) {
  return has_instruction() ? ~sum_by_instruction(~sum, bytes, size)
                           : sf_crc32c_by_tables(sum, bytes, size);
}
