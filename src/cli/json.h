/* JSON: the characters of a string, for every writer; and one object on one line, which is made in
 * memory so that it is written in one go.
 *
 * INVARIANT  The object is valid JSON whatever its texts contain: bytes that are not UTF-8 come out
 * as U+FFFD, and a text that is too long is cut.
 */
#ifndef CS_CLI_JSON_H
#define CS_CLI_JSON_H

#include <stddef.h>
#include <stdint.h>

typedef enum cs_json_place {
  CS_JSON_LINE = 0, /* a line of its own: bytes that are not UTF-8 become U+FFFD */
  CS_JSON_HTML      /* inside a script element: nothing in it can end that, or begin a tag; bytes
                       above ASCII are copied as they are */
} cs_json_place;

enum { CS_JSON_CHARACTER = 8 }; /* bytes of the longest escape, and a zero */

/* Writes the first character of the text, which is not "", as it is written inside a JSON string;
 * *size: bytes written. The answer: bytes of the text that it was read from. */
size_t cs_json_character(const char *text, cs_json_place place, char out[CS_JSON_CHARACTER],
                         size_t *size);

typedef struct cs_json {
  size_t length;
  char text[12288];
} cs_json;

void cs_json_begin(cs_json *json);
/* Each adds a member; names need no escapes. */
void cs_json_text(cs_json *json, const char *name, const char *value);
void cs_json_integer(cs_json *json, const char *name, int64_t value);
void cs_json_number(cs_json *json, const char *name, double value);
/* A list of whole numbers; what does not fit is left out. */
void cs_json_integers(cs_json *json, const char *name, const int64_t *values, size_t count);
/* Ends the object and its line. The text stays the json's. */
const char *cs_json_end(cs_json *json);

#endif
