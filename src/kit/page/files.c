/* The files of a page, below the C library: it asks these functions instead of a kernel.
 *
 *   fopen, stat, ... of the C library -> files.c -> cs_page_find, cs_page_read of engine.mjs
 *
 * JavaScript has the bytes, and notes what was looked for and is not there. A file does not change
 * while it is open. Nothing can be written. What is missing here fails as ENOSYS (engine.mjs).
 */
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <wasi/api.h>

/* The C library declares its own functions in none of its headers. */
#pragma GCC diagnostic ignored "-Wmissing-prototypes"

#define FROM_PAGE(name) __attribute__((import_module("page"), import_name(#name)))

enum { MISSING = -1, FOLDER = -2 };

/* The number of a file, from 0; MISSING or FOLDER. */
FROM_PAGE(find) int cs_page_find(const char *path);
FROM_PAGE(size) int cs_page_size(int file);
/* Copies bytes of a file, which has as many. */
FROM_PAGE(read) void cs_page_read(int file, size_t at, void *to, size_t size);

enum { FIRST = 3, COUNT = 64 }; /* descriptors; those before the first are not files */

static struct {
  bool is_open;
  int file;
  size_t at; /* where the next byte is read; at most the size */
} descriptors[COUNT];

static int slot_of(int descriptor) {
  int slot = descriptor - FIRST;
  return slot >= 0 && slot < COUNT && descriptors[slot].is_open ? slot : -1;
}

static int describe(int file, struct stat *out) {
  *out = (struct stat){.st_mode = file == FOLDER ? S_IFDIR | 0755 : S_IFREG | 0444,
                       .st_nlink = 1,
                       .st_ino = (ino_t)(file + 3), /* a folder has 1 */
                       .st_size = file == FOLDER ? 0 : cs_page_size(file)};
  return 0;
}

/* ---------------------------------------------------------------- by path */

long __syscall_openat(long folder, long path, long flags, ...) {
  (void)folder;
  int file = cs_page_find((const char *)path), slot = 0;
  if (file < 0)
    return file == FOLDER ? -EISDIR : -ENOENT;
  if ((flags & O_ACCMODE) != O_RDONLY)
    return -EROFS;
  while (slot < COUNT && descriptors[slot].is_open)
    slot++;
  if (slot == COUNT)
    return -EMFILE;
  descriptors[slot].is_open = true;
  descriptors[slot].file = file;
  descriptors[slot].at = 0;
  return slot + FIRST;
}

long __syscall_open(long path, long flags, ...) { return __syscall_openat(0, path, flags); }

long __syscall_stat64(long path, long out) {
  int file = cs_page_find((const char *)path);
  return file == MISSING ? -ENOENT : describe(file, (struct stat *)out);
}

long __syscall_lstat64(long path, long out) { return __syscall_stat64(path, out); }

long __syscall_faccessat(long folder, long path, long mode, long flags) {
  (void)folder, (void)flags;
  int file = cs_page_find((const char *)path);
  return file == MISSING ? -ENOENT : (mode & 2) ? -EROFS : 0; /* 2: to write */
}

long __syscall_getcwd(long out, long size) {
  if (size < 2)
    return -ERANGE;
  strcpy((char *)out, "/");
  return 2;
}

/* ---------------------------------------------------------------- by descriptor */

long __syscall_fstat64(long descriptor, long out) {
  int slot = slot_of((int)descriptor);
  return slot < 0 ? -EBADF : describe(descriptors[slot].file, (struct stat *)out);
}

long __syscall_fstatat64(long folder, long path, long out, long flags) {
  bool is_of_descriptor = (flags & AT_EMPTY_PATH) && !*(const char *)path;
  return is_of_descriptor ? __syscall_fstat64(folder, out) : __syscall_stat64(path, out);
}

/* Reads from `at` on into the parts, and returns how many bytes there were. */
static size_t read_parts(int file, size_t at, const __wasi_iovec_t *parts, size_t count) {
  size_t done = 0, size = (size_t)cs_page_size(file);
  for (size_t i = 0; i < count && at + done < size; i++) {
    size_t left = size - at - done, part = parts[i].buf_len < left ? parts[i].buf_len : left;
    cs_page_read(file, at + done, parts[i].buf, part);
    done += part;
  }
  return done;
}

__wasi_errno_t __wasi_fd_read(__wasi_fd_t descriptor, const __wasi_iovec_t *parts, size_t count,
                              __wasi_size_t *out) {
  int slot = slot_of((int)descriptor);
  if (slot < 0)
    return __WASI_ERRNO_BADF;
  *out = read_parts(descriptors[slot].file, descriptors[slot].at, parts, count);
  descriptors[slot].at += *out;
  return __WASI_ERRNO_SUCCESS;
}

__wasi_errno_t __wasi_fd_pread(__wasi_fd_t descriptor, const __wasi_iovec_t *parts, size_t count,
                               __wasi_filesize_t at, __wasi_size_t *out) {
  int slot = slot_of((int)descriptor);
  if (slot < 0)
    return __WASI_ERRNO_BADF;
  *out = at > SIZE_MAX ? 0 : read_parts(descriptors[slot].file, (size_t)at, parts, count);
  return __WASI_ERRNO_SUCCESS;
}

__wasi_errno_t __wasi_fd_seek(__wasi_fd_t descriptor, __wasi_filedelta_t by, __wasi_whence_t whence,
                              __wasi_filesize_t *out) {
  int slot = slot_of((int)descriptor);
  if (slot < 0)
    return __WASI_ERRNO_BADF;
  __wasi_filedelta_t size = cs_page_size(descriptors[slot].file);
  __wasi_filedelta_t from = whence == __WASI_WHENCE_SET   ? 0
                            : whence == __WASI_WHENCE_CUR ? (__wasi_filedelta_t)descriptors[slot].at
                                                          : size;
  if (by < -from || by > size - from)
    return __WASI_ERRNO_INVAL;
  descriptors[slot].at = (size_t)(from + by);
  *out = (__wasi_filesize_t)(from + by);
  return __WASI_ERRNO_SUCCESS;
}

__wasi_errno_t __wasi_fd_close(__wasi_fd_t descriptor) {
  int slot = slot_of((int)descriptor);
  if (slot < 0)
    return __WASI_ERRNO_BADF;
  descriptors[slot].is_open = false;
  return __WASI_ERRNO_SUCCESS;
}
