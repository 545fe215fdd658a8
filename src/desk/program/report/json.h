/* JSON: one object on one line, which is made in memory so that it is written in one call.
 *
 * INVARIANT  The object is valid JSON whatever its texts contain: bytes that are not UTF-8 come out
 * as U+FFFD, and a text that is too long is cut.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct cs_json {
  size_t length;
  char text[12288];
} cs_json;

void cs_json_begin(cs_json *json);
/* Each function adds a member; names need no escapes. */
void cs_json_text(cs_json *json, const char *name, const char *value);
void cs_json_integer(cs_json *json, const char *name, int64_t value);
void cs_json_number(cs_json *json, const char *name, double value);
/* A list of whole numbers; numbers that do not fit are left out. */
void cs_json_integers(cs_json *json, const char *name, const int64_t *values, size_t count);
/* Ends the object and its line. The text belongs to the json. */
const char *cs_json_end(cs_json *json);
