#include "program/report/json.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "readers/text/utf8.h"

enum {
  CHARACTER = 8, /* bytes of the longest escape, and a zero */
  RESERVE = 4096 /* for the members after the longest texts and lists */
};

/* ---------------------------------------------------------------- characters */

/* Writes the first character of the text, which is not "", in the form for a JSON string. *size:
 * the number of bytes written. Returns the number of bytes that were read from the text. */
static size_t write_character(const char *text, char out[CHARACTER], size_t *size) {
  static const char REPLACEMENT[] = "\xef\xbf\xbd"; /* U+FFFD */
  const unsigned char *bytes = (const unsigned char *)text;
  if (*bytes < ' ' || *bytes == 0x7f || *bytes == '"' || *bytes == '\\') {
    bool is_short = *bytes == '"' || *bytes == '\\';
    *size = (size_t)snprintf(out, CHARACTER, is_short ? "\\%c" : "\\u%04x", *bytes);
    return 1;
  }
  size_t length = cs_utf8_length(text);
  *size = length ? length : sizeof REPLACEMENT - 1;
  memcpy(out, length ? text : REPLACEMENT, *size);
  return length ? length : 1;
}

/* ---------------------------------------------------------------- the object */

/* Appends a text if it fits as a whole; the end of the object always fits. */
static void append(cs_json *json, const char *text, size_t size) {
  if (json->length + size >= sizeof json->text - CHARACTER)
    return;
  memcpy(json->text + json->length, text, size);
  json->length += size;
}

static void name_member(cs_json *json, const char *name) {
  char start[80];
  bool is_first = json->length == 1;
  int size = snprintf(start, sizeof start, "%s\"%s\":", is_first ? "" : ",", name);
  append(json, start, (size_t)size);
}

void cs_json_begin(cs_json *json) {
  json->length = 0;
  append(json, "{", 1);
}

void cs_json_text(cs_json *json, const char *name, const char *value) {
  char character[CHARACTER];
  size_t size;
  name_member(json, name);
  append(json, "\"", 1);
  while (*value && json->length < sizeof json->text - RESERVE) {
    value += write_character(value, character, &size);
    append(json, character, size);
  }
  append(json, "\"", 1);
}

void cs_json_integer(cs_json *json, const char *name, int64_t value) {
  char digits[24];
  name_member(json, name);
  append(json, digits, (size_t)snprintf(digits, sizeof digits, "%" PRId64, value));
}

void cs_json_number(cs_json *json, const char *name, double value) {
  char digits[32];
  name_member(json, name);
  append(json, digits, (size_t)snprintf(digits, sizeof digits, "%.3f", value));
}

void cs_json_integers(cs_json *json, const char *name, const int64_t *values, size_t count) {
  char digits[24];
  name_member(json, name);
  append(json, "[", 1);
  for (size_t i = 0; i < count && json->length < sizeof json->text - RESERVE; i++) {
    int size = snprintf(digits, sizeof digits, "%s%" PRId64, i ? "," : "", values[i]);
    append(json, digits, (size_t)size);
  }
  append(json, "]", 1);
}

const char *cs_json_end(cs_json *json) {
  memcpy(json->text + json->length, "}\n", 3);
  return json->text;
}
