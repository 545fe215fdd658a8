/* 128-bit structural hashes: equal values hash alike in every process and on every machine.
 *
 * A hash is built by feeding a kind tag, then every field in a fixed order; doubles are fed by
 * their bits (minus zero as zero), lists with their length first.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct cs_hash {
  uint64_t a, b;
} cs_hash;

cs_hash cs_hash_begin(uint64_t kind);
void cs_hash_word(cs_hash *hash, uint64_t word);
void cs_hash_number(cs_hash *hash, double number);
void cs_hash_numbers(cs_hash *hash, const double *numbers, size_t count);
void cs_hash_bytes(cs_hash *hash, const void *bytes, size_t size);
void cs_hash_text(cs_hash *hash, const char *text); /* NULL differs from "" */
void cs_hash_hash(cs_hash *hash, cs_hash other);
cs_hash cs_hash_end(cs_hash hash); /* final avalanche */
