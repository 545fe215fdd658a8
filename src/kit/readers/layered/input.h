/* The file of a painting, or the part of one: bytes at offsets.
 *
 * INVARIANT: an open input is a regular file, and while `is_known` is set, every opening finds the
 * same, unchanged file. The file is open only between cs_input_open and cs_input_close, so that a
 * painting of a thousand layers needs no descriptor while none of them is read.
 *
 * An input is used by one thread at a time.
 */
#pragma once

#include "inside/context.h"

typedef struct cs_input {
  const char *path;           /* borrowed; for bytes in memory, a name for messages */
  const unsigned char *bytes; /* borrowed: the bytes of the file; NULL: the file is on the disc */
  int descriptor;             /* valid while the file is open */
  bool is_known;              /* the facts below describe the file when it was first opened */
  int64_t size;
  int64_t time; /* nanoseconds */
  uint64_t number;
} cs_input;

/* Errors: INPUT, with the path. */
CELSPAN_CHECKED celspan_status cs_input_open(celspan_context *context, cs_input *input);
void cs_input_close(cs_input *input);
/* Exactly `size` bytes at `offset`. Errors: INPUT, with the byte at which the file ends. */
CELSPAN_CHECKED celspan_status cs_input_read(celspan_context *context, const cs_input *input,
                                             int64_t offset, void *bytes, size_t size);
/* Records "path: byte N: sentence", and returns status. offset < 0: without the byte. */
celspan_status cs_input_fail(celspan_context *context, const cs_input *input, int64_t offset,
                             celspan_status status, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Reading a part of a file number by number.
 *
 * INVARIANT: after a failure every number read is 0, nothing more is read, and `status` keeps the
 * failure: therefore a sequence of numbers is checked once, at its end. A cursor never passes its
 * end.
 */
typedef struct cs_cursor {
  celspan_context *context; /* borrowed, as the input */
  const cs_input *input;
  celspan_status status;
  int64_t at, end; /* places in the file */
  int64_t first;   /* the offset of the bytes in the buffer */
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
/* The end of a section of `size` bytes that begins at the cursor. If it would be beyond the
 * cursor's own end, records a failure and returns the cursor's end. what: the section, for the
 * message. */
int64_t cs_cursor_section(cs_cursor *cursor, uint64_t size, const char *what);
/* Records a failure at the cursor. */
void cs_cursor_fail(cs_cursor *cursor, celspan_status status, const char *sentence);
