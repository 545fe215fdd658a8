/* The bytes of a span file: sizes, letters and numbers, as docs/spanfile.md specifies them.
 *
 *   file       header (46) | records of rows and of the index ... | trailer (40) | footer (26)
 *   a record   kind (1) | size of the payload (varint, 1..9) | payload | checksum (4)
 *
 *   payload of 'P'   packets:  kind (1) | count - 1 (2) | pixels:  raw: count, run: 1, gradient: 2
 *   payload of 'M'   two bits for each span but the last | varints | pixels of raw, gradient spans
 *   payload of 'S'   nothing
 *   payload of 'I'   level (4) | entries:  row (4) | offset (8)
 *
 * INVARIANT: all numbers are little endian, whatever the machine.
 */
#pragma once

#include <string.h>

#include "spanfile.h"

enum {
  SF_HEADER_BYTES = 46, /* a Targa header and its image ID */
  SF_ID_BYTES = 28,
  SF_IMAGE_TYPE = 197, /* 128 and more are for private use (TGA 2.0) */
  SF_TRAILER_BYTES = 40,
  SF_FOOTER_BYTES = 26,
  SF_END_BYTES = SF_TRAILER_BYTES + SF_FOOTER_BYTES,

  SF_PACKET_MOST = 32768, /* pixels */
  SF_NODE_ENTRIES = 512,
  SF_ENTRY_BYTES = 12,
  SF_LEVELS = 4,       /* 512^4 is more than there can be rows */
  SF_LENGTH_BYTES = 9, /* of a varint that is a size, at most */
  SF_CHECK_BYTES = 4,
  SF_KEY_ROWS = SPANFILE_PART_ROWS, /* the number of rows between key rows */
  SF_KEY_BYTES = 64 * 1024          /* after this many bytes, the next row is a key row */
};

/* The kind of a record, its first byte. */
enum { SF_PACKETS = 'P', SF_MOVED = 'M', SF_SAME = 'S', SF_INDEX = 'I' };
/* In the checksum of an index record, in place of the number of a row. */
#define SF_INDEX_ROW UINT32_MAX

static const unsigned char sf_magic[8] = {'c', 'e', 'l', 's', 'p', 'a', 'n', 1};
static const unsigned char sf_end_magic[8] = {'s', 'p', 'a', 'n', 's', 'e', 'n', 'd'};
/* No extension area and no developer directory: their offsets have 32 bits. */
static const unsigned char sf_footer[SF_FOOTER_BYTES] = "\0\0\0\0\0\0\0\0TRUEVISION-XFILE.";

/* Whether a picture may have the place that it claims in a larger one. */
static inline bool sf_has_place(const spanfile_info *info) {
  uint64_t end = (uint64_t)info->strip_row + info->height;
  if (info->strip_height == 0)
    return info->strip_row == 0;
  return info->strip_row % SPANFILE_PART_ROWS == 0 && end <= info->strip_height &&
         (end % SPANFILE_PART_ROWS == 0 || end == info->strip_height);
}

/* To little endian, and back. */
static inline uint32_t sf_little_32(uint32_t number) {
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  return number >> 24 | (number >> 8 & 0xff00) | (number << 8 & 0xff0000) | number << 24;
#else
  return number;
#endif
}
static inline void sf_store_32(unsigned char *at, uint32_t number) {
  number = sf_little_32(number);
  memcpy(at, &number, sizeof number);
}
static inline void sf_store_64(unsigned char *at, uint64_t number) {
  sf_store_32(at, (uint32_t)number);
  sf_store_32(at + 4, (uint32_t)(number >> 32));
}
static inline uint32_t sf_load_32(const unsigned char *at) {
  uint32_t number;
  memcpy(&number, at, sizeof number);
  return sf_little_32(number);
}
static inline uint64_t sf_load_64(const unsigned char *at) {
  return sf_load_32(at) | (uint64_t)sf_load_32(at + 4) << 32;
}

static inline void sf_store_pixel(unsigned char *at, size_t pixel_size, uint64_t pixel) {
  sf_store_32(at, (uint32_t)pixel);
  if (pixel_size == 8)
    sf_store_32(at + 4, (uint32_t)(pixel >> 32));
}
static inline uint64_t sf_load_pixel(const unsigned char *at, size_t pixel_size) {
  return pixel_size == 8 ? sf_load_64(at) : sf_load_32(at);
}

/* A varint: seven bits a byte, the lowest first, the top bit set in all but the last byte. Returns
 * the count of bytes: at most 5 for 32 bits, 10 for 64. */
static inline size_t sf_store_varint(unsigned char *at, uint64_t number) {
  size_t size = 0;
  for (; number >= 0x80; number >>= 7)
    at[size++] = (unsigned char)(number | 0x80);
  at[size++] = (unsigned char)number;
  return size;
}
/* Returns the bytes read, or 0 when the number does not end within `most` bytes. */
static inline size_t sf_load_varint(const unsigned char *at, size_t most, uint64_t *number) {
  *number = 0;
  for (size_t i = 0; i < most; i++) {
    *number |= (uint64_t)(at[i] & 0x7f) << 7 * i;
    if (at[i] < 0x80)
      return i + 1;
  }
  return 0;
}

/* 0, -1, 1, -2, 2, ... as 0, 1, 2, 3, 4, ... */
static inline uint64_t sf_zigzag(int64_t number) {
  return number < 0 ? ~((uint64_t)number << 1) : (uint64_t)number << 1;
}
static inline int64_t sf_unzigzag(uint64_t code) {
  return code & 1 ? -(int64_t)(code >> 1) - 1 : (int64_t)(code >> 1);
}
