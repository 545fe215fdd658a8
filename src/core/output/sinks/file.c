#include "output/sinks/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <zlib.h>

#include "base/error_text.h"
#include "base/open.h"
#include "output/sinks/temporary.h"

enum { BUFFER_BYTES = 1 << 16, NAME_ATTEMPTS = 1000 };

struct cs_file {
  const cs_file_system *system;
  size_t allocated;
  int descriptor;
  const char *failed_to; /* NULL, or what failed first; `error` is its errno */
  int error;
  uint64_t flushed; /* bytes from the start that the system has received */
  size_t buffered;
  bool is_summed;
  uint32_t sum; /* CRC-32 */
  char *path, *temporary;
  size_t folder_length; /* the length of the folder in both names, including the last slash */
  unsigned char buffer[BUFFER_BYTES];
};

/* bytes that are hashed at a time; existing records depend on this number */
enum { CHUNK = 1 << 16 };
/* bytes that are read again at a time */
enum { AGAIN = 3 << 14 };

bool cs_file_contents_read(int descriptor, cs_file_contents *out) {
  unsigned char chunk[CHUNK];
  ssize_t got;
  *out = (cs_file_contents){.hash = cs_hash_begin(2)};
  do {
    got = cs_open_read_at(descriptor, chunk, CHUNK, (off_t)out->bytes);
    if (got < 0)
      return false;
    if (got > 0)
      cs_hash_bytes(&out->hash, chunk, (size_t)got);
    out->bytes += (uint64_t)got;
  } while (got == CHUNK);
  out->hash = cs_hash_end(out->hash);
  return true;
}

static int system_open(const char *path, int flags, mode_t mode) { return open(path, flags, mode); }

static const cs_file_system real_system = {.open = system_open,
                                           .pwrite = pwrite,
                                           .fstat = fstat,
                                           .fsync = fsync,
                                           .close = close,
                                           .rename = rename,
                                           .unlink = unlink,
                                           .mkdir = mkdir};

static celspan_status report(const cs_file *file, celspan_context *context) {
  char text[CS_ERROR_TEXT_SIZE];
  return cs_fail(context, CELSPAN_OUTPUT, "%s: %s: %s", file->path, file->failed_to,
                 cs_error_text(file->error, text));
}

static celspan_status fail(cs_file *file, celspan_context *context, const char *failed_to) {
  file->error = errno;
  file->failed_to = failed_to;
  return report(file, context);
}

static void release(cs_file *file, celspan_context *context) {
  cs_mem_free(context->memory, file, file->allocated);
}

/* ---------------------------------------------------------------- opening */

static cs_file *allocate(celspan_context *context, const char *path) {
  size_t length = strlen(path), size = sizeof(cs_file) + 2 * length + 2 + CS_TEMPORARY_EXTRA;
  cs_file *file = cs_mem_resize(context->memory, NULL, 0, size);
  if (!file)
    return NULL;
  const char *slash = strrchr(path, '/');
  memset(file, 0, offsetof(cs_file, buffer));
  file->allocated = size;
  file->descriptor = -1;
  file->path = (char *)(file + 1);
  file->temporary = file->path + length + 1;
  file->folder_length = slash ? (size_t)(slash + 1 - path) : 0;
  memcpy(file->path, path, length + 1);
  file->temporary[0] = '\0';
  return file;
}

/* Makes every folder of the path that is missing. */
static int make_folders(cs_file *file) {
  for (size_t i = 1; i < file->folder_length; i++) {
    if (file->path[i] != '/' || file->path[i - 1] == '/')
      continue;
    file->path[i] = '\0';
    int result = file->system->mkdir(file->path, 0777);
    file->path[i] = '/';
    if (result != 0 && errno != EEXIST)
      return -1;
  }
  return 0;
}

static int open_again(const cs_file_system *system, const char *path, int flags, mode_t mode) {
  int descriptor;
  do
    descriptor = system->open(path, flags, mode);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

/* Tries names until one is free, because another process may be writing the same frame. */
static int open_temporary(cs_file *file) {
  size_t room = file->allocated - sizeof *file - strlen(file->path) - 1;
  unsigned start = (unsigned)getpid();
  for (unsigned i = 0; i < NAME_ATTEMPTS; i++) {
    cs_temporary_name(file->path, start + i, file->temporary, room);
    file->descriptor = open_again(file->system, file->temporary,
                                  O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file->descriptor >= 0 ? cs_temporary_claim(file->descriptor) : errno != EEXIST)
      break;
    if (file->descriptor < 0)
      continue;
    cs_temporary_drop(file->descriptor, file->temporary);
    file->system->close(file->descriptor);
    file->descriptor = -1;
  }
  return file->descriptor >= 0 ? 0 : -1;
}

static celspan_status open_file(cs_file *file, celspan_context *context) {
  struct stat there;
  if (file->path[file->folder_length] == '\0')
    return cs_fail(context, CELSPAN_OUTPUT, "%s: cannot write: a file's name is needed",
                   file->path);
  if (stat(file->path, &there) == 0 && !S_ISREG(there.st_mode))
    return cs_fail(context, CELSPAN_OUTPUT,
                   "%s: cannot write: it exists and is not an ordinary file", file->path);
  if (open_temporary(file) == 0)
    return CELSPAN_OK;
  if (errno != ENOENT)
    return fail(file, context, "cannot create");
  if (make_folders(file) != 0)
    return fail(file, context, "cannot make its folder");
  return open_temporary(file) == 0 ? CELSPAN_OK : fail(file, context, "cannot create");
}

celspan_status cs_file_create(celspan_context *context, const cs_file_system *system,
                              const char *path, cs_file **out) {
  cs_file *file = allocate(context, path);
  if (!file)
    return cs_fail_memory(context);
  file->system = system ? system : &real_system;
  celspan_status status = open_file(file, context);
  if (status == CELSPAN_OK)
    *out = file;
  else
    release(file, context);
  return status;
}

/* ---------------------------------------------------------------- writing */

static celspan_status write_all(cs_file *file, celspan_context *context, uint64_t offset,
                                const unsigned char *bytes, size_t size) {
  while (size > 0) {
    ssize_t written = file->system->pwrite(file->descriptor, bytes, size, (off_t)offset);
    if (written < 0 && errno == EINTR)
      continue;
    if (written == 0)
      errno = ENOSPC;
    if (written <= 0)
      return fail(file, context, "cannot write");
    bytes += written;
    offset += (uint64_t)written;
    size -= (size_t)written;
  }
  return CELSPAN_OK;
}

static celspan_status check_usable(const cs_file *file, celspan_context *context) {
  return file->failed_to ? report(file, context) : CELSPAN_OK;
}

static celspan_status flush(cs_file *file, celspan_context *context) {
  CS_TRY(write_all(file, context, file->flushed, file->buffer, file->buffered));
  file->flushed += file->buffered;
  file->buffered = 0;
  return CELSPAN_OK;
}

celspan_status cs_file_write(cs_file *file, celspan_context *context, const void *bytes,
                             size_t size) {
  CS_TRY(check_usable(file, context));
  if (file->is_summed)
    file->sum = (uint32_t)crc32_z(file->sum, bytes, size);
  if (size > BUFFER_BYTES - file->buffered)
    CS_TRY(flush(file, context));
  if (size >= BUFFER_BYTES) {
    CS_TRY(write_all(file, context, file->flushed, bytes, size));
    file->flushed += size;
  } else if (size > 0) {
    memcpy(file->buffer + file->buffered, bytes, size);
    file->buffered += size;
  }
  return CELSPAN_OK;
}

void cs_file_sum_begin(cs_file *file) {
  file->is_summed = true;
  file->sum = 0;
}

uint32_t cs_file_sum_end(cs_file *file) {
  file->is_summed = false;
  return file->sum;
}

celspan_status cs_file_write_at(cs_file *file, celspan_context *context, uint64_t offset,
                                const void *bytes, size_t size) {
  CS_TRY(check_usable(file, context));
  CS_TRY(flush(file, context));
  CS_TRY(write_all(file, context, offset, bytes, size));
  if (offset + size > file->flushed)
    file->flushed = offset + size;
  return CELSPAN_OK;
}

uint64_t cs_file_size(const cs_file *file) { return file->flushed + file->buffered; }

/* ---------------------------------------------------------------- ending */

/* File systems that cannot sync return EINVAL; then nothing more can be done. */
static int sync_descriptor(const cs_file_system *system, int descriptor) {
  int result;
  do
    result = system->fsync(descriptor);
  while (result != 0 && errno == EINTR);
  return result != 0 && errno == EINVAL ? 0 : result;
}

/* The descriptor is closed even if a signal interrupts the call. */
static int close_descriptor(const cs_file_system *system, int descriptor) {
  int result = system->close(descriptor);
  return result != 0 && errno == EINTR ? 0 : result;
}

static int sync_folder(cs_file *file) {
  char end = file->path[file->folder_length];
  file->path[file->folder_length] = '\0';
  int folder = open_again(file->system, file->folder_length ? file->path : ".",
                          O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  file->path[file->folder_length] = end;
  if (folder < 0)
    return -1;
  int result = sync_descriptor(file->system, folder);
  return close_descriptor(file->system, folder) != 0 ? -1 : result;
}

static celspan_status check_size(cs_file *file, celspan_context *context) {
  struct stat there;
  if (file->system->fstat(file->descriptor, &there) != 0)
    return fail(file, context, "cannot check its size");
  if ((uint64_t)there.st_size == file->flushed)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_OUTPUT, "%s: cannot write: it has %lld bytes instead of %llu",
                 file->path, (long long)there.st_size, (unsigned long long)file->flushed);
}

static celspan_status close_and_rename(cs_file *file, celspan_context *context) {
  int descriptor = file->descriptor;
  file->descriptor = -1;
  if (close_descriptor(file->system, descriptor) != 0)
    return fail(file, context, "cannot close");
  if (file->system->rename(file->temporary, file->path) != 0)
    return fail(file, context, "cannot rename");
  return CELSPAN_OK;
}

/* Some systems report lost bytes only at `close`, so the file is closed before it gets its name. A
 * second descriptor keeps the lock until then; without the lock, another process would remove the
 * file as a remnant. */
static celspan_status finish(cs_file *file, celspan_context *context) {
  CS_TRY(check_usable(file, context));
  CS_TRY(flush(file, context));
  CS_TRY(check_size(file, context));
  if (sync_descriptor(file->system, file->descriptor) != 0)
    return fail(file, context, "cannot sync");
  if (context->contents && !cs_file_contents_read(file->descriptor, context->contents))
    return fail(file, context, "cannot read it back");
  int locked = cs_open_twice(file->descriptor);
  if (locked < 0)
    return fail(file, context, "cannot close");
  celspan_status status = close_and_rename(file, context);
  close(locked);
  CS_TRY(status);
  file->temporary[0] = '\0';
  return sync_folder(file) == 0 ? CELSPAN_OK : fail(file, context, "cannot sync its folder");
}

celspan_status cs_file_temporary(cs_file *file, celspan_context *context, const char **name) {
  CS_TRY(check_usable(file, context));
  CS_TRY(flush(file, context));
  *name = file->temporary;
  return CELSPAN_OK;
}

celspan_status cs_file_again(cs_file *file, celspan_context *context,
                             celspan_status (*take)(void *user, const void *bytes, size_t size),
                             void *user) {
  unsigned char part[AGAIN];
  CS_TRY(check_usable(file, context));
  CS_TRY(flush(file, context));
  for (uint64_t at = 0; at < file->flushed; at += AGAIN) {
    uint64_t left = file->flushed - at;
    size_t size = left < AGAIN ? (size_t)left : AGAIN;
    errno = EIO; /* where the file has become shorter */
    if (cs_open_read_at(file->descriptor, part, size, (off_t)at) != (ssize_t)size)
      return fail(file, context, "cannot read its temporary file back");
    CS_TRY(take(user, part, size));
  }
  return CELSPAN_OK;
}

celspan_status cs_file_adopt(cs_file *file, celspan_context *context) {
  struct stat there;
  CS_TRY(check_usable(file, context));
  if (file->system->fstat(file->descriptor, &there) != 0)
    return fail(file, context, "cannot check its size");
  file->flushed = (uint64_t)there.st_size;
  file->buffered = 0;
  return CELSPAN_OK;
}

celspan_status cs_file_commit(cs_file *file, celspan_context *context) {
  celspan_status status = finish(file, context);
  if (status == CELSPAN_OK)
    release(file, context);
  else
    cs_file_discard(file, context);
  return status;
}

void cs_file_discard(cs_file *file, celspan_context *context) {
  if (!file)
    return;
  if (file->descriptor >= 0)
    close_descriptor(file->system, file->descriptor);
  if (file->temporary[0] != '\0')
    file->system->unlink(file->temporary);
  release(file, context);
}

celspan_status cs_file_end(cs_file *file, celspan_context *context, celspan_status outcome) {
  if (outcome == CELSPAN_OK)
    return cs_file_commit(file, context);
  cs_file_discard(file, context);
  return outcome;
}

/* ---------------------------------------------------------------- names */

const char *cs_file_ending(const char *path) {
  const char *slash = strrchr(path, '/');
  const char *dot = strrchr(slash ? slash + 1 : path, '.');
  return dot ? dot + 1 : "";
}
