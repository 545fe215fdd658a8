/* Files of movies, which are opened by name here and nowhere else. */
#pragma once

#include "base/context.h"

/* A file that was opened, and what changes when the file changes. */
typedef struct cs_kind_file {
  const char *kind; /* the name of its container in ffmpeg */
  int descriptor;
  int64_t size, time; /* nanoseconds */
  uint64_t number;
} cs_kind_file;

/* Opens a movie; the caller closes its descriptor. tried: another path that does not exist either,
 * or NULL. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_kind_open(celspan_context *context, const char *path,
                                            const char *tried, cs_kind_file *out);
