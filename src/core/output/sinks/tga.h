/* Shared by writing and joining of Targa files: sizes, numbers and the end of a file (Truevision,
 * 1991).
 *
 *   header (18) | image ID of a strip (12) | packets of rows | extension (495) | footer (26)
 *                                          |<------ body --->|
 *
 * INVARIANT: the footer says where the extension begins. Offsets have 32 bits, so a file whose
 * body ends beyond them has no extension.
 */
#pragma once

#include "output/sinks/file.h"

enum {
  CS_TGA_SIDE_MOST = 65535,
  CS_TGA_HEADER = 18,
  CS_TGA_PLACE = 12, /* the image ID of a strip */
  CS_TGA_EXTENSION = 495,
  CS_TGA_FOOTER = 26
};

/* The last bytes of every file and of its footer. */
#define CS_TGA_SIGNATURE "TRUEVISION-XFILE."

static inline void cs_tga_store_16(unsigned char *at, unsigned number) {
  at[0] = (unsigned char)number;
  at[1] = (unsigned char)(number >> 8);
}
static inline void cs_tga_store_32(unsigned char *at, uint32_t number) {
  cs_tga_store_16(at, number & 0xffff);
  cs_tga_store_16(at + 2, number >> 16);
}
static inline unsigned cs_tga_load_16(const unsigned char *at) {
  return at[0] | (unsigned)at[1] << 8;
}
static inline uint32_t cs_tga_load_32(const unsigned char *at) {
  return cs_tga_load_16(at) | (uint32_t)cs_tga_load_16(at + 2) << 16;
}

/* Writes the extension and the footer behind the last packet. Errors: OUTPUT. */
CELSPAN_CHECKED celspan_status cs_tga_put_end(cs_file *file, celspan_context *context,
                                              const unsigned char extension[CS_TGA_EXTENSION]);
