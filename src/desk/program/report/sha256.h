/* SHA-256 of bytes that come in parts. Source: FIPS 180-4, sections 5 and 6.2. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define CS_SHA256_SIZE 32

typedef struct cs_sha256 {
  uint32_t state[8];
  uint64_t size;       /* bytes that were added */
  uint8_t pending[64]; /* the last size % 64 bytes, which the state does not have */
} cs_sha256;

void cs_sha256_begin(cs_sha256 *sum);
void cs_sha256_add(cs_sha256 *sum, const void *bytes, size_t size);
/* The sum can then only begin again. */
void cs_sha256_end(cs_sha256 *sum, uint8_t digest[CS_SHA256_SIZE]);
