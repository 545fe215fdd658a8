#include "base/description.h"

#include <string.h>

/* of any description: a larger size means that struct_size was never set */
enum { SIZE_MOST = 4096 };

static celspan_status refuse(celspan_context *context, const char *noun,
                             const cs_description *description, size_t size, const char *what) {
  if (!context)
    return CELSPAN_BAD_ARGUMENT;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "%s: struct_size is %zu, %s: begin with the defaults that %s_default sets, or set "
                 "it to sizeof(%s), which is %zu",
                 noun, size, what, description->type, description->type, description->size);
}

/* Whether a structure that begins with a size_t can have this size. */
static bool is_size(size_t size) {
  return size >= sizeof size && size <= SIZE_MOST && size % sizeof size == 0;
}

static bool is_zero(const void *given, size_t begin, size_t end) {
  const unsigned char *bytes = given;
  while (begin < end && bytes[begin] == 0)
    begin++;
  return begin == end;
}

celspan_status cs_description_read(celspan_context *context, const char *noun,
                                   const cs_description *description, const void *given,
                                   void *out) {
  if (!given)
    return context ? cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: the description is missing", noun)
                   : CELSPAN_BAD_ARGUMENT;
  size_t size;
  memcpy(&size, given, sizeof size);
  if (!is_size(size))
    return refuse(context, noun, description, size, "which no description has");
  if (size < description->needed)
    return refuse(context, noun, description, size, "so that fields are missing that it needs");
  if (size > description->size && !is_zero(given, description->size, size))
    return refuse(context, noun, description, size,
                  "and fields that this version of the library does not have are not zero");
  cs_description_write(description, description->defaults, out, description->size);
  memcpy(out, given, size < description->size ? size : description->size);
  memcpy(out, &description->size, sizeof description->size);
  return CELSPAN_OK;
}

/* Writes the first bytes of a full structure into one that has another size. */
static void write_part(const void *full, size_t known, void *out, size_t size) {
  if (known > size)
    known = size;
  memcpy(out, full, known);
  memset((char *)out + known, 0, size - known);
  memcpy(out, &size, sizeof size);
}

void cs_description_write(const cs_description *description, const void *full, void *out,
                          size_t size) {
  if (size >= sizeof size)
    write_part(full, description->size, out, size);
}

celspan_status cs_result_write(celspan_context *context, const char *noun, const char *type,
                               const void *full, size_t size, void *out) {
  size_t given;
  memcpy(&given, out, sizeof given);
  if (is_size(given)) {
    write_part(full, size, out, given);
    return CELSPAN_OK;
  }
  if (!context)
    return CELSPAN_BAD_ARGUMENT;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "%s: struct_size of the result is %zu: begin with %s_initial, or set it to "
                 "sizeof(%s), which is %zu",
                 noun, given, type, type, size);
}
