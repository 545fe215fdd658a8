#include "output/sinks/file_copy.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"
#include "output/sinks/file.h"

enum { CHUNK = 1 << 16 };

/* outcome: the result of the system call that filled `found`. */
static bool fill_stamp(int outcome, const struct stat *found, cs_file_stamp *out) {
  *out = (cs_file_stamp){found->st_dev, found->st_ino, found->st_size, found->st_ctim};
  return outcome == 0 && S_ISREG(found->st_mode);
}

bool cs_file_stamp_read(const char *path, cs_file_stamp *out) {
  struct stat found = {0};
  return fill_stamp(stat(path, &found), &found, out);
}

static bool is_same(int descriptor, const cs_file_stamp *stamp) {
  struct stat found = {0};
  cs_file_stamp now;
  return fill_stamp(fstat(descriptor, &found), &found, &now) && now.device == stamp->device &&
         now.number == stamp->number && now.size == stamp->size &&
         now.changed.tv_sec == stamp->changed.tv_sec &&
         now.changed.tv_nsec == stamp->changed.tv_nsec;
}

/* Returns false, with errno, if the file could not be read to its end. */
static bool copy_bytes(celspan_context *context, int descriptor, cs_file *file,
                       celspan_status *status) {
  unsigned char chunk[CHUNK];
  ssize_t size;
  while ((size = read(descriptor, chunk, sizeof chunk)) != 0) {
    if (size < 0 && errno == EINTR)
      continue;
    if (size < 0)
      return false;
    *status = cs_file_write(file, context, chunk, (size_t)size);
    if (*status != CELSPAN_OK)
      return true;
  }
  return true;
}

static celspan_status copy(celspan_context *context, int descriptor, const cs_file_stamp *stamp,
                           const char *to, bool *copied) {
  cs_file *file;
  CS_TRY(cs_file_create(context, NULL, to, &file));
  celspan_status status = CELSPAN_OK;
  bool is_whole = copy_bytes(context, descriptor, file, &status) && is_same(descriptor, stamp);
  *copied = is_whole && status == CELSPAN_OK;
  if (*copied)
    return cs_file_commit(file, context);
  cs_file_discard(file, context);
  return status;
}

celspan_status cs_file_copy(celspan_context *context, const char *from, const cs_file_stamp *stamp,
                            const char *to, bool *copied) {
  *copied = false;
  int descriptor = cs_open_to_read(from);
  if (descriptor < 0)
    return CELSPAN_OK;
  celspan_status status = CELSPAN_OK;
  if (is_same(descriptor, stamp))
    status = copy(context, descriptor, stamp, to, copied);
  close(descriptor);
  return status;
}
