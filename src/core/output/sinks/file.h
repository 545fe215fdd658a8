/* Files that appear whole or not at all.
 *
 * Bytes go to a temporary file `.NAME.XXXX.part` in the same folder; cs_file_commit syncs it,
 * checks its size, renames it and syncs the folder.
 *
 *   write --> buffer --> .NAME.XXXX.part --commit: check, sync, rename--> NAME, sync of the folder
 *                              +---------discard: unlink
 *
 * INVARIANT: until the rename, a file that was there under the name is untouched; and however it
 * ends, no temporary file is left. Errors stick: after a failed write the file can only be
 * discarded or fail to commit.
 */
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include "base/context.h"
#include "base/hash.h"

typedef struct cs_file cs_file;

/* The contents of a completed file. If `contents` of a context points to such a structure, it gets
 * the contents of the last file that the context committed. They are read from the temporary file,
 * which no other process has opened, before the file gets its name. Later changes of the file do
 * not change them. */
typedef struct cs_file_contents {
  cs_hash hash;
  uint64_t bytes;
} cs_file_contents;

/* Reads the whole file from its first byte on. false: it cannot be read; errno has the reason. */
bool cs_file_contents_read(int descriptor, cs_file_contents *out);

/* The system calls that a file needs, as in POSIX; tests replace them to make them fail. */
typedef struct cs_file_system {
  int (*open)(const char *path, int flags, mode_t mode);
  ssize_t (*pwrite)(int descriptor, const void *bytes, size_t size, off_t offset);
  int (*fstat)(int descriptor, struct stat *out);
  int (*fsync)(int descriptor);
  int (*close)(int descriptor);
  int (*rename)(const char *from, const char *to);
  int (*unlink)(const char *path);
  int (*mkdir)(const char *path, mode_t mode);
} cs_file_system;

/* Opens the temporary file, and creates missing folders. path: copied. system: NULL for the real
 * calls; otherwise borrowed until the file ends. Errors: OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_file_create(celspan_context *context,
                                              const cs_file_system *system, const char *path,
                                              cs_file **out);
/* Appends. */
CELSPAN_CHECKED celspan_status cs_file_write(cs_file *file, celspan_context *context,
                                             const void *bytes, size_t size);
/* Writes at any offset, over earlier bytes or beyond them; cs_file_write still appends at the
 * end. */
CELSPAN_CHECKED celspan_status cs_file_write_at(cs_file *file, celspan_context *context,
                                                uint64_t offset, const void *bytes, size_t size);
/* The CRC-32 of the bytes that are appended from a call of the first function to one of the
 * second. */
void cs_file_sum_begin(cs_file *file);
uint32_t cs_file_sum_end(cs_file *file);
/* Bytes from the start to the end. */
uint64_t cs_file_size(const cs_file *file);
/* Passes all bytes so far to the system, so that the temporary file can be read. *name: its name,
 * borrowed until the file ends. */
CELSPAN_CHECKED celspan_status cs_file_temporary(cs_file *file, celspan_context *context,
                                                 const char **name);
/* Gives all bytes so far to `take`, in parts whose size is a multiple of 3, except the last one's.
 * Errors: OUTPUT, and those of `take`, which end it. */
CELSPAN_CHECKED celspan_status cs_file_again(cs_file *file, celspan_context *context,
                                             celspan_status (*take)(void *user, const void *bytes,
                                                                    size_t size),
                                             void *user);
/* Takes the output of another program, written under the temporary name, as the file's contents. */
CELSPAN_CHECKED celspan_status cs_file_adopt(cs_file *file, celspan_context *context);
/* All three functions end the file, whatever they return. discard ignores NULL. */
CELSPAN_CHECKED celspan_status cs_file_commit(cs_file *file, celspan_context *context);
/* Commits the file if `outcome`, the status of writing it, is OK; otherwise discards it. Returns
 * the first failure. */
CELSPAN_CHECKED celspan_status cs_file_end(cs_file *file, celspan_context *context,
                                           celspan_status outcome);
void cs_file_discard(cs_file *file, celspan_context *context);

/* The ending of a file's name, which gives its format unless it is given elsewhere: the text after
 * the last dot in the last part of the path; "" if there is no dot. Points into the path. */
const char *cs_file_ending(const char *path);
