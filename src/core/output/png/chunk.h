/* Chunks of PNG files (PNG 3rd edition, 5): what files are made of.
 *
 *   size of the data (4 bytes) | type (4) | data | CRC-32 of type and data (4)
 *
 * INVARIANT: numbers have their highest byte first.
 */
#pragma once

#include "output/sinks/file.h"

enum { CS_PNG_SIGNATURE = 8, CS_PNG_HEADER = 13, CS_PNG_CHUNK_HEAD = 8, CS_PNG_CHUNK_TAIL = 4 };

extern const unsigned char cs_png_signature[CS_PNG_SIGNATURE];

static inline void cs_png_store_32(unsigned char *at, uint32_t number) {
  for (int i = 0; i < 4; i++)
    at[i] = (unsigned char)(number >> (24 - 8 * i));
}
static inline uint32_t cs_png_load_32(const unsigned char *at) {
  return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* The bytes before the data of a chunk, and those after it. */
void cs_png_chunk_ends(const char *type, const void *bytes, size_t size,
                       unsigned char head[CS_PNG_CHUNK_HEAD],
                       unsigned char tail[CS_PNG_CHUNK_TAIL]);
/* Writes a chunk. Errors: OUTPUT. */
CELSPAN_CHECKED celspan_status cs_png_chunk_put(cs_file *file, celspan_context *context,
                                                const char *type, const void *bytes, size_t size);
