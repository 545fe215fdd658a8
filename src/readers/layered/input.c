#include "readers/layered/input.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"

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
