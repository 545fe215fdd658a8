/* The sentence of an errno, for any thread.
 *
 * Two functions are called strerror_r: GNU's answers a text, which need not be in the buffer;
 * POSIX's, which musl has, fills the buffer and answers 0 or an error. The
 * type of the function shows which one it is.
 */
#pragma once

#include <stdio.h>
#include <string.h>

#define CS_ERROR_TEXT_SIZE 256

static inline const char *cs_error_text_gnu(const char *answer, char *text, int number) {
  (void)text, (void)number;
  return answer;
}

static inline const char *cs_error_text_posix(int answer, char *text, int number) {
  if (answer != 0)
    snprintf(text, CS_ERROR_TEXT_SIZE, "error %d", number);
  return text;
}

/* number: an errno. text: a buffer for the answer. */
static inline const char *cs_error_text(int number, char text[CS_ERROR_TEXT_SIZE]) {
  text[0] = '\0';
  return _Generic(strerror_r(number, text, CS_ERROR_TEXT_SIZE), int
                  : cs_error_text_posix, default
                  : cs_error_text_gnu)(strerror_r(number, text, CS_ERROR_TEXT_SIZE), text, number);
}
