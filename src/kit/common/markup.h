/* Texts in documents of XML. */
#pragma once

#include <string.h>

/* What stands for a character: an entity where the character has a meaning in XML, a space for a
 * control character, which has no place there, and otherwise the character itself. room: for it. */
static inline const char *cs_markup_of(char c, char room[2]) {
  if (c == '&')
    return "&amp;";
  if (c == '<')
    return "&lt;";
  if (c == '"')
    return "&quot;";
  room[0] = c >= 0 && c < ' ' ? ' ' : c;
  room[1] = '\0';
  return room;
}

enum { CS_MARKUP_MOST = 6 }; /* the most bytes for one of a text */

/* Writes a text, and a zero byte behind it. Returns where that is. */
static inline char *cs_markup_put(char *out, const char *text) {
  char room[2];
  *out = '\0';
  for (; *text; text++)
    out = stpcpy(out, cs_markup_of(*text, room));
  return out;
}
