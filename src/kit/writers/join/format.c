#include "writers/join/format.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "inside/files.h"

celspan_status cs_join_part_fail(celspan_context *context, const cs_join_part *part,
                                 const char *format, ...) {
  char reason[400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(reason, sizeof reason, format, arguments);
  va_end(arguments);
  return cs_fail(context, CELSPAN_INPUT, "%s: %s", part->path, reason);
}

celspan_status cs_join_part_open(celspan_context *context, const char *path, cs_join_part *out) {
  struct stat there;
  *out = (cs_join_part){.path = path};
  out->descriptor = cs_open_to_read(path);
  if (out->descriptor < 0 || fstat(out->descriptor, &there) != 0) {
    cs_join_part_fail(context, out, "%s", strerror(errno));
    cs_join_part_close(out);
    return CELSPAN_INPUT;
  }
  out->size = S_ISREG(there.st_mode) ? (uint64_t)there.st_size : 0;
  if (S_ISREG(there.st_mode))
    return CELSPAN_OK;
  cs_join_part_close(out);
  return cs_join_part_fail(context, out, "is not a file");
}

void cs_join_part_close(cs_join_part *part) {
  if (part->descriptor >= 0)
    close(part->descriptor);
  part->descriptor = -1;
}

celspan_status cs_join_part_read(celspan_context *context, const cs_join_part *part,
                                 uint64_t offset, void *bytes, size_t size) {
  if (offset > part->size || size > part->size - offset)
    return cs_join_part_fail(context, part,
                             "is truncated: it ends at byte %llu; render the "
                             "strip again",
                             (unsigned long long)part->size);
  ssize_t got = cs_open_read_at(part->descriptor, bytes, size, (off_t)offset);
  if (got < 0)
    return cs_join_part_fail(context, part, "bytes from %llu on cannot be read: %s",
                             (unsigned long long)offset, strerror(errno));
  if ((size_t)got < size)
    return cs_join_part_fail(context, part, "has become shorter while it was read");
  return CELSPAN_OK;
}
