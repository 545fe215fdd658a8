/* Source: The Unicode Standard, 3.9, table 3-7 (well-formed UTF-8 byte sequences). */
#include "readers/text/utf8.h"

#include <string.h>

#include "common/utf8.h"

/* The number of bytes of a character that begins with this byte; 0 if no character does. */
static int length_of(unsigned char first) {
  return first < 0x80   ? 1
         : first < 0xc2 ? 0
         : first < 0xe0 ? 2
         : first < 0xf0 ? 3
         : first < 0xf5 ? 4
                        : 0;
}

/* The character at `at`, or UINT32_MAX; *length: the number of its bytes. */
static uint32_t decode(const unsigned char *at, size_t left, int *length) {
  static const unsigned char masks[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  *length = length_of(*at);
  if (*length == 0 || (size_t)*length > left)
    return UINT32_MAX;
  uint32_t character = at[0] & masks[*length];
  for (int i = 1; i < *length; i++) {
    if ((at[i] & 0xc0) != 0x80)
      return UINT32_MAX;
    character = character << 6 | (at[i] & 0x3fu);
  }
  bool is_surrogate = character >= 0xd800 && character < 0xe000;
  return character < least[*length] || character > 0x10ffff || is_surrogate ? UINT32_MAX
                                                                            : character;
}

static bool is_control(uint32_t character) {
  return (character < 0x20 && character != '\n') || (character >= 0x7f && character < 0xa0);
}

size_t cs_utf8_length(const char *text) {
  int length;
  uint32_t character = decode((const unsigned char *)text, strnlen(text, 4), &length);
  return character == UINT32_MAX ? 0 : (size_t)length;
}

celspan_status cs_utf8_decode(celspan_context *context, const char *noun, const char *bytes,
                              size_t size, uint32_t *characters, uint32_t *places, size_t *count) {
  size_t made = 0;
  int length;
  for (size_t at = 0; at < size; at += (size_t)length) {
    uint32_t character = decode((const unsigned char *)bytes + at, size - at, &length);
    if (character == UINT32_MAX)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: the text is not UTF-8 at byte %zu (0x%02x)", noun, at + 1,
                     (unsigned char)bytes[at]);
    if (character == '\r' && at + 1 < size && bytes[at + 1] == '\n')
      continue;
    if (is_control(character))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: control character U+%04X at byte %zu; only line breaks are allowed", noun,
                     character, at + 1);
    characters[made] = character;
    places[made++] = (uint32_t)at;
  }
  *count = made;
  return CELSPAN_OK;
}

cs_utf8_text cs_utf8_encode(uint32_t character) {
  cs_utf8_text out = {{0}};
  cs_utf8_put(out.text, character);
  return out;
}
