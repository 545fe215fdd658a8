/* Copies of files that were just written, provided that they are still the same.
 *
 * INVARIANT: a copy has the bytes that the original had when its stamp was read. Every write to a
 * file, and every other file under its name, changes the stamp.
 */
#pragma once

#include <sys/types.h>
#include <time.h>

#include "base/context.h"

/* Identifies a file and its content at a moment. */
typedef struct cs_file_stamp {
  dev_t device;
  ino_t number;
  off_t size;
  struct timespec changed;
} cs_file_stamp;

/* false if there is no regular file of that name. */
bool cs_file_stamp_read(const char *path, cs_file_stamp *out);

/* Copies `from` to a new file, which appears whole or not at all (output/sinks/file.h). If `from`
 * is missing or no longer has the stamp, *copied is false and nothing is written. Errors: OUTPUT,
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_file_copy(celspan_context *context, const char *from,
                                            const cs_file_stamp *stamp, const char *to,
                                            bool *copied);
