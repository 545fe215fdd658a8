#include "output/png/chunk.h"

#include <string.h>
#include <zlib.h>

const unsigned char cs_png_signature[CS_PNG_SIGNATURE] = {0x89, 'P',  'N',  'G',
                                                          '\r', '\n', 0x1a, '\n'};

void cs_png_chunk_ends(const char *type, const void *bytes, size_t size,
                       unsigned char head[CS_PNG_CHUNK_HEAD],
                       unsigned char tail[CS_PNG_CHUNK_TAIL]) {
  cs_png_store_32(head, (uint32_t)size);
  memcpy(head + 4, type, 4);
  uLong sum = crc32_z(crc32_z(0, head + 4, 4), bytes, size);
  cs_png_store_32(tail, (uint32_t)sum);
}

celspan_status cs_png_chunk_put(cs_file *file, celspan_context *context, const char *type,
                                const void *bytes, size_t size) {
  unsigned char head[CS_PNG_CHUNK_HEAD], tail[CS_PNG_CHUNK_TAIL];
  cs_png_chunk_ends(type, bytes, size, head, tail);
  CS_TRY(cs_file_write(file, context, head, sizeof head));
  CS_TRY(cs_file_write(file, context, bytes, size));
  return cs_file_write(file, context, tail, sizeof tail);
}
