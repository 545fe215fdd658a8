/* Numbers in files, by the order of their bytes. */
#pragma once

#include <stdint.h>

static inline uint16_t cs_bytes_big16(const unsigned char *at) {
  return (uint16_t)(at[0] << 8 | at[1]);
}
static inline uint32_t cs_bytes_big32(const unsigned char *at) {
  return (uint32_t)cs_bytes_big16(at) << 16 | cs_bytes_big16(at + 2);
}
static inline uint64_t cs_bytes_big64(const unsigned char *at) {
  return (uint64_t)cs_bytes_big32(at) << 32 | cs_bytes_big32(at + 4);
}
static inline uint16_t cs_bytes_little16(const unsigned char *at) {
  return (uint16_t)(at[1] << 8 | at[0]);
}
static inline uint32_t cs_bytes_little32(const unsigned char *at) {
  return (uint32_t)cs_bytes_little16(at + 2) << 16 | cs_bytes_little16(at);
}
static inline uint64_t cs_bytes_little64(const unsigned char *at) {
  return (uint64_t)cs_bytes_little32(at + 4) << 32 | cs_bytes_little32(at);
}

/* These store a number of up to 8 bytes, and return where it ends. */
static inline unsigned char *cs_bytes_put_big(unsigned char *at, uint64_t number, int bytes) {
  for (int i = bytes; i-- > 0;)
    *at++ = (unsigned char)(number >> 8 * i);
  return at;
}
static inline unsigned char *cs_bytes_put_little(unsigned char *at, uint64_t number, int bytes) {
  for (int i = 0; i < bytes; i++)
    *at++ = (unsigned char)(number >> 8 * i);
  return at;
}
