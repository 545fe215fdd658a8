/* Files of movies, which are opened by name here and nowhere else. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/files.h"
#include "plugins/footage/listing.h"
#include "plugins/isolate/media_kind.h"

static celspan_status refuse(celspan_context *context, const char *path, const char *tried,
                             int error) {
  return cs_fail(context, CELSPAN_INPUT, "the movie %s cannot be opened: %s%s%s", path,
                 strerror(error), tried ? "; also looked for at " : "", tried ? tried : "");
}

static celspan_status recognize(celspan_context *context, const char *path, cs_kind_file *file) {
  struct stat found;
  if (fstat(file->descriptor, &found) != 0)
    return refuse(context, path, NULL, errno);
  if (!S_ISREG(found.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "the movie %s is not a file; a movie must be one", path);
  file->kind = cs_media_kind(file->descriptor, CS_MEDIA_MOVIE);
  if (!file->kind && errno)
    return refuse(context, path, NULL, errno);
  file->size = (int64_t)found.st_size;
  file->time = (int64_t)found.st_mtim.tv_sec * 1000000000 + found.st_mtim.tv_nsec;
  file->number = (uint64_t)found.st_ino;
  if (!file->kind)
    return cs_fail(context, CELSPAN_INPUT,
                   "the movie %s has none of the formats that are read, which are found by the "
                   "first bytes of a file and not by its name: convert it to " CS_MEDIA_MOVIES,
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
