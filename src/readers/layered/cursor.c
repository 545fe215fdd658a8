#include "readers/layered/cursor.h"

#include <string.h>

#include "readers/layered/bytes.h"

void cs_cursor_init(cs_cursor *cursor, celspan_context *context, const cs_input *input, int64_t at,
                    int64_t end) {
  cursor->context = context;
  cursor->input = input;
  cursor->status = CELSPAN_OK;
  cursor->at = at;
  cursor->end = end;
  cursor->first = at;
  cursor->count = 0;
}

void cs_cursor_fail(cs_cursor *cursor, celspan_status status, const char *sentence) {
  if (cursor->status == CELSPAN_OK)
    cursor->status =
        cs_input_fail(cursor->context, cursor->input, cursor->at, status, "%s", sentence);
}

/* Fills the buffer so that it contains the byte at the cursor. */
static void refill(cs_cursor *cursor) {
  int64_t left = cursor->end - cursor->at;
  cursor->first = cursor->at;
  cursor->count = left < (int64_t)sizeof cursor->buffer ? (size_t)left : sizeof cursor->buffer;
  cursor->status =
      cs_input_read(cursor->context, cursor->input, cursor->at, cursor->buffer, cursor->count);
}

static bool is_buffered(const cs_cursor *cursor) {
  return cursor->at >= cursor->first && cursor->at < cursor->first + (int64_t)cursor->count;
}

void cs_cursor_bytes(cs_cursor *cursor, void *out, size_t size) {
  if (cursor->status == CELSPAN_OK && (uint64_t)size > (uint64_t)(cursor->end - cursor->at))
    cs_cursor_fail(cursor, CELSPAN_INPUT, "a section ends in the middle of what it holds");
  memset(out, 0, size);
  for (size_t done = 0, step; done < size && cursor->status == CELSPAN_OK; done += step) {
    step = 0;
    if (!is_buffered(cursor))
      refill(cursor);
    if (cursor->status != CELSPAN_OK)
      continue;
    size_t place = (size_t)(cursor->at - cursor->first), ready = cursor->count - place;
    step = size - done < ready ? size - done : ready;
    memcpy((unsigned char *)out + done, cursor->buffer + place, step);
    cursor->at += (int64_t)step;
  }
}

void cs_cursor_skip(cs_cursor *cursor, uint64_t count) {
  if (cursor->status == CELSPAN_OK && count > (uint64_t)(cursor->end - cursor->at))
    cs_cursor_fail(cursor, CELSPAN_INPUT, "a section is larger than the one it lies in");
  if (cursor->status == CELSPAN_OK)
    cursor->at += (int64_t)count;
}

uint8_t cs_cursor_8(cs_cursor *cursor) {
  unsigned char byte[1];
  cs_cursor_bytes(cursor, byte, sizeof byte);
  return byte[0];
}

uint16_t cs_cursor_16(cs_cursor *cursor) {
  unsigned char bytes[2];
  cs_cursor_bytes(cursor, bytes, sizeof bytes);
  return cs_bytes_big16(bytes);
}

uint32_t cs_cursor_32(cs_cursor *cursor) {
  unsigned char bytes[4];
  cs_cursor_bytes(cursor, bytes, sizeof bytes);
  return cs_bytes_big32(bytes);
}

uint64_t cs_cursor_64(cs_cursor *cursor) {
  unsigned char bytes[8];
  cs_cursor_bytes(cursor, bytes, sizeof bytes);
  return cs_bytes_big64(bytes);
}

int64_t cs_cursor_section(cs_cursor *cursor, uint64_t size, const char *what) {
  if (cursor->status == CELSPAN_OK && size <= (uint64_t)(cursor->end - cursor->at))
    return cursor->at + (int64_t)size;
  if (cursor->status == CELSPAN_OK)
    cursor->status = cs_input_fail(cursor->context, cursor->input, cursor->at, CELSPAN_INPUT,
                                   "%s should have %llu bytes; only %lld follow", what,
                                   (unsigned long long)size, (long long)(cursor->end - cursor->at));
  return cursor->end;
}
