/* Reading a part of a file number by number.
 *
 * INVARIANT: after a failure every number read is 0, nothing more is read, and `status` keeps the
 * failure: so a run of numbers is checked once, at its end. A cursor never passes its end.
 */
#pragma once

#include "readers/layered/input.h"

typedef struct cs_cursor {
  celspan_context *context; /* borrowed, as the input */
  const cs_input *input;
  celspan_status status;
  int64_t at, end; /* of the file */
  int64_t first;   /* of the bytes in the buffer */
  size_t count;
  unsigned char buffer[4096];
} cs_cursor;

void cs_cursor_init(cs_cursor *cursor, celspan_context *context, const cs_input *input, int64_t at,
                    int64_t end);
void cs_cursor_bytes(cs_cursor *cursor, void *out, size_t size);
void cs_cursor_skip(cs_cursor *cursor, uint64_t count);
/* Big-endian numbers. */
uint8_t cs_cursor_8(cs_cursor *cursor);
uint16_t cs_cursor_16(cs_cursor *cursor);
uint32_t cs_cursor_32(cs_cursor *cursor);
uint64_t cs_cursor_64(cs_cursor *cursor);
/* The end of a section of `size` bytes that begins here; a failure where it passes the cursor's own
 * end; the result is then that end. what: the section, for the message. */
int64_t cs_cursor_section(cs_cursor *cursor, uint64_t size, const char *what);
/* Records a failure at the cursor. */
void cs_cursor_fail(cs_cursor *cursor, celspan_status status, const char *sentence);
