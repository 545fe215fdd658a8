#include "program/report/sha256.h"

#include <string.h>

enum { PART = 64, ROUNDS = 64, LENGTH = 8 };

/* The first 32 bits of the fractional parts of the cube roots of the first 64 primes. */
static const uint32_t roots[ROUNDS] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t turned(uint32_t x, int count) { return x >> count | x << (32 - count); }

static uint32_t word_at(const uint8_t *bytes) {
  return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The words of 64 bytes, and those that follow from them. */
static void schedule(const uint8_t *part, uint32_t words[ROUNDS]) {
  for (int i = 0; i < 16; i++)
    words[i] = word_at(part + 4 * i);
  for (int i = 16; i < ROUNDS; i++) {
    uint32_t a = words[i - 15], b = words[i - 2];
    words[i] = words[i - 16] + (turned(a, 7) ^ turned(a, 18) ^ a >> 3) + words[i - 7] +
               (turned(b, 17) ^ turned(b, 19) ^ b >> 10);
  }
}

static void add_part(uint32_t state[8], const uint8_t *part) {
  uint32_t words[ROUNDS], s[8];
  schedule(part, words);
  memcpy(s, state, sizeof s);
  for (int i = 0; i < ROUNDS; i++) {
    uint32_t choice = (s[4] & s[5]) ^ (~s[4] & s[6]);
    uint32_t majority = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]);
    uint32_t a = s[7] + (turned(s[4], 6) ^ turned(s[4], 11) ^ turned(s[4], 25)) + choice +
                 roots[i] + words[i];
    uint32_t b = (turned(s[0], 2) ^ turned(s[0], 13) ^ turned(s[0], 22)) + majority;
    memmove(s + 1, s, 7 * sizeof *s);
    s[4] += a;
    s[0] = a + b;
  }
  for (int i = 0; i < 8; i++)
    state[i] += s[i];
}

/* The fractional parts of the square roots of the first 8 primes. */
void cs_sha256_begin(cs_sha256 *sum) {
  *sum = (cs_sha256){.state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f,
                               0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void cs_sha256_add(cs_sha256 *sum, const void *bytes, size_t size) {
  const uint8_t *from = bytes;
  while (size > 0) {
    size_t at = sum->size % PART;
    size_t part = size < PART - at ? size : PART - at;
    memcpy(sum->pending + at, from, part);
    sum->size += part;
    from += part;
    size -= part;
    if (at + part == PART)
      add_part(sum->state, sum->pending);
  }
}

/* A bit 1, bits 0, and the number of bits that were added, up to the end of a part of 64 bytes. */
void cs_sha256_end(cs_sha256 *sum, uint8_t digest[CS_SHA256_SIZE]) {
  uint8_t tail[PART + LENGTH] = {0x80};
  uint64_t bits = 8 * sum->size;
  size_t zeros = (2 * PART - 1 - LENGTH - sum->size % PART) % PART;
  for (int i = 0; i < LENGTH; i++)
    tail[1 + zeros + (size_t)i] = (uint8_t)(bits >> (8 * (LENGTH - 1 - i)));
  cs_sha256_add(sum, tail, 1 + zeros + LENGTH);
  for (int i = 0; i < CS_SHA256_SIZE; i++)
    digest[i] = (uint8_t)(sum->state[i / 4] >> (24 - 8 * (i % 4)));
}
