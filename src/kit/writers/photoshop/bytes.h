/* The bytes of Photoshop documents and colour profiles. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* Stores a number of up to 4 bytes, the highest first, and returns where it ends. */
static inline unsigned char *cs_big_endian_store(unsigned char *at, uint32_t number, int bytes) {
  for (int i = bytes; i-- > 0;)
    *at++ = (unsigned char)(number >> 8 * i);
  return at;
}

/* PackBits, a packing of bytes by runs.
 * Source: TIFF Revision 6.0 (Adobe, 1992), section 9.
 *
 *   0 .. 127     this number of bytes and one more follow
 *   129 .. 255   the byte that follows is repeated 257 minus this number of times
 */
/* The most bytes that `size` bytes are packed into. */
#define CS_PACK_BITS_MOST(size) ((size) + ((size) + 127) / 128)

/* Packs a row, and returns the number of bytes. out: of CS_PACK_BITS_MOST(size) bytes. */
size_t cs_pack_bits(const unsigned char *row, size_t size, unsigned char *out);

/* A colour profile of sRGB, for files that say by one what their codes mean.
 * Source: ICC.1:2010 (profile version 4.3); IEC 61966-2-1.
 */
enum { CS_SRGB_PROFILE = 496 }; /* bytes */

void cs_srgb_profile(unsigned char out[CS_SRGB_PROFILE]);
