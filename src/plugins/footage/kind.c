#include "plugins/footage/kind.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"

enum { HEAD = 192, PACKET = 188 /* bytes of a packet of a transport stream */ };

static bool has(const unsigned char *bytes, size_t offset, const char *name) {
  return memcmp(bytes + offset, name, strlen(name)) == 0;
}

static const char *kind_of(const unsigned char bytes[HEAD]) {
  static const char *const boxes[] = {"ftyp", "moov", "mdat", "wide"};
  for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++)
    if (has(bytes, 4, boxes[i]))
      return "mov";
  if (has(bytes, 0, "\x1a\x45\xdf\xa3"))
    return "matroska";
  if (has(bytes, 0, "RIFF") && has(bytes, 8, "AVI "))
    return "avi";
  if (has(bytes, 0, "\x06\x0e\x2b\x34"))
    return "mxf";
  if (has(bytes, 0, "OggS"))
    return "ogg";
  if (has(bytes, 0, "YUV4MPEG2 "))
    return "yuv4mpegpipe";
  return bytes[0] == 0x47 && bytes[PACKET] == 0x47 ? "mpegts" : NULL;
}

static celspan_status refuse(celspan_context *context, const char *path, const char *tried,
                             int error) {
  return cs_fail(context, CELSPAN_INPUT, "the movie %s cannot be opened: %s%s%s", path,
                 strerror(error), tried ? "; also looked for at " : "", tried ? tried : "");
}

/* Missing bytes of a shorter file are zeros. */
static celspan_status recognize(celspan_context *context, const char *path, cs_kind_file *file) {
  unsigned char bytes[HEAD] = {0};
  struct stat found;
  if (fstat(file->descriptor, &found) != 0)
    return refuse(context, path, NULL, errno);
  if (!S_ISREG(found.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "the movie %s is not a file; a movie must be one", path);
  if (cs_open_read_at(file->descriptor, bytes, HEAD, 0) < 0)
    return refuse(context, path, NULL, errno);
  file->kind = kind_of(bytes);
  file->size = (int64_t)found.st_size;
  file->time = (int64_t)found.st_mtim.tv_sec * 1000000000 + found.st_mtim.tv_nsec;
  file->number = (uint64_t)found.st_ino;
  if (!file->kind)
    return cs_fail(context, CELSPAN_INPUT,
                   "the movie %s has none of the formats that are read, which are found by the "
                   "first bytes of a file and not by its name: convert it to " CS_KIND_NAMES,
                   path);
  return CELSPAN_OK;
}

celspan_status cs_kind_open(celspan_context *context, const char *path, const char *tried,
                            cs_kind_file *out) {
  *out = (cs_kind_file){.descriptor = cs_open_to_read(path)};
  if (out->descriptor < 0)
    return refuse(context, path, tried, errno);
  celspan_status status = recognize(context, path, out);
  if (status != CELSPAN_OK)
    close(out->descriptor);
  return status;
}
