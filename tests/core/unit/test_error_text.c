/* Sentences of errnos from POSIX's strerror_r, for which this file is compiled, as with musl;
 * test_file.c tests the variant with which celspan is compiled.
 */
#undef _GNU_SOURCE
#undef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#include <errno.h>

#include "base/error_text.h"
#include "tests/support/check.h"

int main(void) {
  static const int numbers[] = {ENOENT, EACCES, ENOSPC, EISDIR};
  char text[CS_ERROR_TEXT_SIZE];
  int (*posix)(int, char *, size_t) = strerror_r; /* does not compile with the other variant */
  CHECK(posix != NULL);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    CHECK_TEXT(cs_error_text(numbers[i], text), strerror(numbers[i]));
  CHECK(strstr(cs_error_text(99999, text), "99999"));
  CHECK_TEXT(cs_error_text_posix(EINVAL, text, 7), "error 7");
  CHECK_TEXT(cs_error_text_gnu("text", text, 7), "text");
  return check_done();
}
