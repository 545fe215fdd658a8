/* The containers of movies, found from the first bytes of a file, whatever its name.
 *
 *   container        first bytes                        in ffmpeg
 *   mp4, mov         a size, ftyp, moov, mdat, wide     mov
 *   mkv, webm        1a 45 df a3                        matroska
 *   avi              RIFF, a size, AVI                  avi
 *   mxf              06 0e 2b 34                        mxf
 *   ogv              OggS                               ogg
 *   ts               47 at 0 and at 188                 mpegts
 *   y4m              YUV4MPEG2                          yuv4mpegpipe
 *
 * INVARIANT: all other files are refused, above all lists of files, addresses and texts.
 */
#pragma once

#include "base/context.h"

/* A file that was opened, and what changes when the file changes. */
typedef struct cs_kind_file {
  const char *kind; /* the name of its container in ffmpeg */
  int descriptor;
  int64_t size, time; /* nanoseconds */
  uint64_t number;
} cs_kind_file;

#define CS_KIND_NAMES "mp4, mov, mkv, webm, avi, mxf, ogv, ts or y4m"

/* Opens a movie; the caller closes its descriptor. tried: another path that does not exist either,
 * or NULL. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_kind_open(celspan_context *context, const char *path,
                                            const char *tried, cs_kind_file *out);
