/* Text of scripts and of files as a terminal may show it: it does not move the cursor, colour or
 * clear anything, or change the clipboard. Controls are written as numbers, such as \x1b, except
 * new lines and tabs. The controls of the set C1 are C2 80 to C2 9F in UTF-8. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { CS_VISIBLE = 5 }; /* bytes of the longest text for one character, with a zero */

/* Writes the visible form of the first character of a text that is not "", and a zero. size: of the
 * text. Returns how many bytes the character has in the text. */
static inline size_t cs_visible_first(const char *text, size_t size, char out[CS_VISIBLE]) {
  const unsigned char *at = (const unsigned char *)text;
  bool is_long = *at == 0xc2 && (size == 1 || (at[1] & 0xe0) == 0x80);
  bool is_shown = (*at >= ' ' || *at == '\n' || *at == '\t') && *at != 0x7f && !is_long;
  bool is_pair = is_long && size > 1;
  out[0] = *text;
  out[1] = 0;
  if (!is_shown)
    snprintf(out, CS_VISIBLE, "\\x%02x", at[is_pair]);
  return is_pair ? 2 : 1;
}
