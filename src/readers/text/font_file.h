/* Files of fonts: read as a whole, and looked over before a library sees them.
 *
 *   0 or 1 'ttcf' --> offset of the first font
 *   font: 'OTTO' or 0x00010000, count, then for each table: tag, checksum, offset, length
 *
 * INVARIANT: every table of a font that was accepted lies inside the file, and it has outlines, and
 * no colours.
 * Source: OpenType 1.9, "Organization of an OpenType Font" (all numbers are big-endian).
 */
#pragma once

#include <sys/stat.h>

#include "base/context.h"

#define CS_FONT_FILE_BYTES ((size_t)256 << 20)

/* Errors: INPUT when it is missing, unreadable or no file. */
CELSPAN_CHECKED celspan_status cs_font_file_stat(celspan_context *context, const char *file,
                                                 struct stat *out);
/* *bytes: new, of `size` bytes, the size that was found above. Errors: NO_MEMORY, INPUT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_font_file_read(celspan_context *context, const char *file,
                                                 size_t size, uint8_t **bytes);
/* face: the number of the font in a collection; any number for a file of one font. Errors: INPUT
 * for a file that is no font or is cut; BAD_ARGUMENT for fonts of bitmaps or colours, and a face
 * that the collection does not have. */
CELSPAN_CHECKED celspan_status cs_font_file_check(celspan_context *context, const char *file,
                                                  const uint8_t *bytes, size_t size, uint32_t face);
bool cs_font_file_is_collection(const uint8_t *bytes, size_t size);
