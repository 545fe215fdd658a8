#include "base/hash.h"

#include <string.h>

/* Two 64-bit lanes with different odd multipliers, which are mixed with each other at every word;
 * at the end xorshifts and multiplications spread every bit over all others. The hash is not
 * cryptographic: it identifies values, and does not protect against forged ones. */

static uint64_t rotate(uint64_t x, int by) { return x << by | x >> (64 - by); }

static uint64_t avalanche(uint64_t x) {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 29;
  x *= 0xa0761d6478bd642fu;
  return x ^ x >> 32;
}

cs_hash cs_hash_begin(uint64_t kind) {
  cs_hash hash = {0x243f6a8885a308d3u, 0x13198a2e03707344u};
  cs_hash_word(&hash, kind);
  return hash;
}

void cs_hash_word(cs_hash *hash, uint64_t word) {
  uint64_t mixed = avalanche(word ^ hash->b);
  hash->b = rotate(hash->b, 23) * 0x9e3779b97f4a7c15u + hash->a;
  hash->a = rotate(hash->a ^ mixed, 29) * 0xbf58476d1ce4e5b9u + word;
}

void cs_hash_number(cs_hash *hash, double number) {
  uint64_t bits;
  double normal = number == 0 ? 0.0 : number;
  memcpy(&bits, &normal, sizeof bits);
  cs_hash_word(hash, bits);
}

void cs_hash_numbers(cs_hash *hash, const double *numbers, size_t count) {
  for (size_t i = 0; i < count; i++)
    cs_hash_number(hash, numbers[i]);
}

void cs_hash_bytes(cs_hash *hash, const void *bytes, size_t size) {
  const unsigned char *at = bytes;
  cs_hash_word(hash, size);
  for (; size >= 8; size -= 8, at += 8) {
    uint64_t word;
    memcpy(&word, at, sizeof word);
    cs_hash_word(hash, word);
  }
  uint64_t rest = 0;
  if (size > 0)
    memcpy(&rest, at, size);
  cs_hash_word(hash, rest);
}

void cs_hash_text(cs_hash *hash, const char *text) {
  cs_hash_word(hash, text != NULL);
  if (text)
    cs_hash_bytes(hash, text, strlen(text));
}

void cs_hash_hash(cs_hash *hash, cs_hash other) {
  cs_hash_word(hash, other.a);
  cs_hash_word(hash, other.b);
}

cs_hash cs_hash_end(cs_hash hash) {
  uint64_t a = avalanche(hash.a + rotate(hash.b, 17));
  return (cs_hash){a, avalanche(hash.b ^ a)};
}
