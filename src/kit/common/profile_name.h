/* The name of the colour profile (ICC) that a file contains, to tell people of it: profiles of
 * pictures are not applied. The picture modules, which are not linked with the core, use it.
 *
 *   profile: header, 128 bytes | tag count | tags: signature, offset, size | values
 *   "desc" (version 2): type, 0, size of the ASCII text, text
 *   "desc" (version 4): type "mluc", 0, count, size of a record, records: language, size, offset
 *
 * Source: ICC.1:2010, 7.3, 10.13; ICC.1:2001-04, 6.5.17.
 */
#pragma once

#include <stdint.h>
#include <string.h>

#include "common/bytes.h"
#include "common/utf8.h"
#include "inside/pictures.h"

#define CS_PROFILE_UNNAMED "without a name"

/* Appends a character in UTF-8; what could end a line becomes a question mark. */
static inline size_t cs_profile_name_put(char out[CS_PICTURE_SPACE], size_t used, uint32_t code) {
  char bytes[4];
  if (code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0xd800 && code < 0xe000))
    code = '?';
  size_t size = cs_utf8_put(bytes, code);
  if (used + size >= CS_PICTURE_SPACE)
    return used;
  memcpy(out + used, bytes, size);
  return used + size;
}

/* The characters of a text in UTF-16, the high bytes first. */
static inline void cs_profile_name_wide(const unsigned char *at, size_t size,
                                        char out[CS_PICTURE_SPACE]) {
  size_t used = 0;
  for (size_t i = 0; i + 1 < size; i += 2) {
    uint32_t code = (uint32_t)at[i] << 8 | at[i + 1];
    if (code == 0)
      break;
    bool is_pair = code >= 0xd800 && code < 0xdc00 && i + 3 < size && at[i + 2] >> 2 == 0x37;
    if (is_pair) {
      code = 0x10000 + ((code & 0x3ff) << 10) + ((uint32_t)(at[i + 2] & 3) << 8 | at[i + 3]);
      i += 2;
    }
    used = cs_profile_name_put(out, used, code);
  }
  out[used] = '\0';
}

static inline void cs_profile_name_plain(const unsigned char *at, size_t size,
                                         char out[CS_PICTURE_SPACE]) {
  size_t used = 0;
  for (size_t i = 0; i < size && at[i]; i++)
    used = cs_profile_name_put(out, used, at[i] < 0x80 ? at[i] : '?');
  out[used] = '\0';
}

/* The text of a description, in its first language. */
static inline void cs_profile_name_text(const unsigned char *value, size_t size,
                                        char out[CS_PICTURE_SPACE]) {
  if (size >= 12 && memcmp(value, "desc", 4) == 0) {
    size_t told = cs_bytes_big32(value + 8), most = size - 12;
    cs_profile_name_plain(value + 12, told < most ? told : most, out);
  } else if (size >= 28 && memcmp(value, "mluc", 4) == 0 && cs_bytes_big32(value + 8) > 0) {
    size_t length = cs_bytes_big32(value + 20), from = cs_bytes_big32(value + 24);
    if (from <= size && length <= size - from)
      cs_profile_name_wide(value + from, length, out);
  }
}

/* Never empty: CS_PROFILE_UNNAMED, if the profile is damaged. */
static inline void cs_profile_name_read(const void *profile, size_t size,
                                        char out[CS_PICTURE_SPACE]) {
  const unsigned char *bytes = (const unsigned char *)profile;
  size_t count = size >= 132 ? cs_bytes_big32(bytes + 128) : 0;
  out[0] = '\0';
  for (size_t i = 0; i < count && i < (size - 132) / 12; i++) {
    const unsigned char *tag = bytes + 132 + 12 * i;
    size_t from = cs_bytes_big32(tag + 4), length = cs_bytes_big32(tag + 8);
    if (memcmp(tag, "desc", 4) == 0 && from <= size && length <= size - from)
      cs_profile_name_text(bytes + from, length, out);
  }
  if (!out[0])
    memcpy(out, CS_PROFILE_UNNAMED, sizeof CS_PROFILE_UNNAMED);
}
