/* UTF-8 as characters.
 *
 * INVARIANT: decoded characters are Unicode scalar values, and no control characters except "\n".
 */
#pragma once

#include "inside/context.h"

/* Appends nothing to the arrays beyond `size` items, which they have room for; a "\r" before a "\n"
 * is left out.
 * noun        for messages: "text"
 * characters  of size items                  places  the byte that each begins at, from 0
 * Errors: BAD_ARGUMENT naming the byte, counted from 1. */
CELSPAN_CHECKED celspan_status cs_utf8_decode(celspan_context *context, const char *noun,
                                              const char *bytes, size_t size, uint32_t *characters,
                                              uint32_t *places, size_t *count);

/* The number of bytes of the first character of a text that is not ""; 0 if it is not UTF-8. */
size_t cs_utf8_length(const char *text);

/* A character as UTF-8, ended by a zero. */
typedef struct cs_utf8_text {
  char text[5];
} cs_utf8_text;
cs_utf8_text cs_utf8_encode(uint32_t character);
