/* PackBits, a packing of bytes by runs.
 * Source: TIFF Revision 6.0 (Adobe, 1992), section 9.
 *
 *   0 .. 127     this number of bytes and one more follow
 *   129 .. 255   the byte that follows is repeated 257 minus this number of times
 */
#pragma once

#include <stddef.h>

/* The most bytes that `size` bytes are packed into. */
#define CS_PACK_BITS_MOST(size) ((size) + ((size) + 127) / 128)

/* Packs a row, and returns the number of bytes. out: of CS_PACK_BITS_MOST(size) bytes. */
size_t cs_pack_bits(const unsigned char *row, size_t size, unsigned char *out);
