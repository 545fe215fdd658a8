#include "readers/layered/input.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/bytes.h"
#include "inside/files.h"

celspan_status cs_input_fail(celspan_context *context, const cs_input *input, int64_t offset,
                             celspan_status status, const char *format, ...) {
  char sentence[CS_ERROR_SIZE / 2], place[32] = "";
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  if (offset >= 0)
    snprintf(place, sizeof place, "byte %lld: ", (long long)offset);
  return cs_fail(context, status, "%s: %s%s", input->path, place, sentence);
}

static celspan_status check_facts(celspan_context *context, cs_input *input) {
  struct stat found;
  if (fstat(input->descriptor, &found) != 0)
    return cs_input_fail(context, input, -1, CELSPAN_INPUT, "cannot be read: %s", strerror(errno));
  if (!S_ISREG(found.st_mode))
    return cs_input_fail(context, input, -1, CELSPAN_INPUT,
                         "is not a file; a painting must be one");
  int64_t time = (int64_t)found.st_mtim.tv_sec * 1000000000 + found.st_mtim.tv_nsec;
  if (input->is_known && (input->size != (int64_t)found.st_size || input->time != time ||
                          input->number != (uint64_t)found.st_ino))
    return cs_input_fail(context, input, -1, CELSPAN_INPUT, "changed while it was in use");
  input->is_known = true;
  input->size = (int64_t)found.st_size;
  input->time = time;
  input->number = (uint64_t)found.st_ino;
  return CELSPAN_OK;
}

celspan_status cs_input_open(celspan_context *context, cs_input *input) {
  if (input->bytes)
    return CELSPAN_OK;
  input->descriptor = cs_open_to_read(input->path);
  if (input->descriptor < 0)
    return cs_input_fail(context, input, -1, CELSPAN_INPUT, "cannot be opened: %s",
                         strerror(errno));
  celspan_status status = check_facts(context, input);
  if (status != CELSPAN_OK)
    cs_input_close(input);
  return status;
}

void cs_input_close(cs_input *input) {
  if (!input->bytes)
    close(input->descriptor);
}

static celspan_status copy_bytes(celspan_context *context, const cs_input *input, int64_t offset,
                                 void *bytes, size_t size) {
  size_t left = (size_t)(input->size - offset);
  if (offset > input->size || size > left)
    return cs_input_fail(context, input, input->size, CELSPAN_INPUT, "the bytes end here");
  memcpy(bytes, input->bytes + offset, size);
  return CELSPAN_OK;
}

celspan_status cs_input_read(celspan_context *context, const cs_input *input, int64_t offset,
                             void *bytes, size_t size) {
  if (input->bytes)
    return copy_bytes(context, input, offset, bytes, size);
  ssize_t got = cs_open_read_at(input->descriptor, bytes, size, offset);
  if (got < 0)
    return cs_input_fail(context, input, offset, CELSPAN_INPUT, "cannot be read: %s",
                         strerror(errno));
  if ((size_t)got < size)
    return cs_input_fail(context, input, offset + got, CELSPAN_INPUT,
                         "the file ends here; %zu more bytes are missing", size - (size_t)got);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the cursor */

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
