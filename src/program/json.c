#include "program/json.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum {
  CHARACTER = 8, /* bytes of the longest escape, and a zero */
  RESERVE = 4096 /* for the members that come after the longest texts and lists */
};

/* ---------------------------------------------------------------- characters */

/* The length of the UTF-8 sequence at text (RFC 3629); 0 when there is none. */
static size_t sequence_length(const unsigned char *text) {
  unsigned char first = text[0], low = 0x80, high = 0xbf;
  size_t length = first < 0x80                     ? 1
                  : first >= 0xc2 && first <= 0xdf ? 2
                  : first >= 0xe0 && first <= 0xef ? 3
                  : first >= 0xf0 && first <= 0xf4 ? 4
                                                   : 0;
  low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : low;
  high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : high;
  for (size_t i = 1; i < length; i++, low = 0x80, high = 0xbf)
    if (text[i] < low || text[i] > high)
      return 0;
  return length;
}

/* Writes the first character of the text, which is not "", as it is written inside a JSON string;
 * *size: bytes written. The answer: bytes of the text that it was read from. */
static size_t write_character(const char *text, char out[CHARACTER], size_t *size) {
  static const char REPLACEMENT[] = "\xef\xbf\xbd"; /* U+FFFD */
  const unsigned char *bytes = (const unsigned char *)text;
  if (*bytes < ' ' || *bytes == 0x7f || *bytes == '"' || *bytes == '\\') {
    bool is_short = *bytes == '"' || *bytes == '\\';
    *size = (size_t)snprintf(out, CHARACTER, is_short ? "\\%c" : "\\u%04x", *bytes);
    return 1;
  }
  size_t length = sequence_length(bytes);
  *size = length ? length : sizeof REPLACEMENT - 1;
  memcpy(out, length ? text : REPLACEMENT, *size);
  return length ? length : 1;
}

/* ---------------------------------------------------------------- the object */

/* Appends what fits whole; the end of the object always does. */
static void append(cs_json *json, const char *text, size_t size) {
  if (json->length + size >= sizeof json->text - CHARACTER)
    return;
  memcpy(json->text + json->length, text, size);
  json->length += size;
}

static void name_member(cs_json *json, const char *name) {
  char start[80];
  int size = snprintf(start, sizeof start, "%s\"%s\":", json->length > 1 ? "," : "", name);
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
