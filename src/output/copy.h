/* Copies of files that were just written, and what tells a file from another of the same name. */
#ifndef CS_OUTPUT_COPY_H
#define CS_OUTPUT_COPY_H

#include <sys/types.h>
#include <time.h>

#include "base/context.h"

/* A file as it stood at a moment: whoever writes it, in place or anew, changes it. */
typedef struct cs_file_stamp {
  dev_t device;
  ino_t number;
  off_t size;
  struct timespec changed;
} cs_file_stamp;

/* false when there is no such ordinary file. */
bool cs_file_stamp_take(const char *path, cs_file_stamp *out);

/* Copies `from` to a file of its own, which appears whole or not at all (output/file.h). *copied is
 * false, and nothing is written, when `from` is not the file of the stamp any more.
 * Errors: OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_file_copy(celspan_context *context, const char *from,
                                            const cs_file_stamp *stamp, const char *to,
                                            bool *copied);

#endif
