/* What ffprobe says of a movie: the facts of its first moving picture, and the times of all
 * pictures, in the order in which they are shown.
 *
 *   packet|stream_index=0|pts=1024|duration=512|flags=K_
 *   stream|index=0|codec_name=h264|codec_type=video|width=320|...
 *
 * INVARIANT: everything is checked, because a malicious movie may control ffprobe: sizes have
 * bounds, ticks are above 0, times ascend and none occurs twice. Pictures that an edit list leaves
 * out are not in it.
 */
#pragma once

#include "inside/context.h"

enum {
  CS_LISTING_SIDE = 32768,      /* pixels */
  CS_LISTING_PICTURES = 4000000 /* pictures of a movie: 46 hours at 24 a second */
};

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

typedef struct cs_listing_picture {
  int64_t time; /* ticks */
  bool is_key;  /* decoding can begin here */
} cs_listing_picture;

typedef struct cs_listing {
  cs_memory *memory;
  int32_t width, height, aspect[2], tick[2], rate[2]; /* fractions; rate 0: not given */
  int turns;                                          /* quarters clockwise, to be upright */
  char codec[32], pixels[32], primaries[32], matrix[32], transfer[32], site[32];
  char range[8];             /* "tv" or "pc", or another word: not given */
  bool has_alpha, has_sound; /* has_alpha: in packets of its own, as of VP9 */
  cs_listing_picture *pictures;
  size_t count, capacity;
  int64_t last; /* ticks for which the last picture is shown; 0: not given */
} cs_listing;

/* Lists a movie. out: for cs_listing_finish, even after a failure. Errors: INPUT, LIMIT, OUTPUT, if
 * there is no ffprobe, NO_MEMORY, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_listing_read(celspan_context *context, const char *path,
                                               const cs_kind_file *file, cs_listing *out);
void cs_listing_finish(cs_listing *listing);
