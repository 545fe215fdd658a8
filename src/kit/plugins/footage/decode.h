/* The raw pictures of a movie, decoded by ffmpeg in a worker (plugins/isolate/media.h).
 *
 *   place   0   1   2   3   4   5   6   7   8
 *           K           .   .   K                K: decoding can begin here
 *                       ^ next: the worker waits with this one, and decodes it meanwhile
 *
 *   asked for 4: decoding continues.  8: a worker begins at 5.  1: a worker begins at 0.
 *
 * Every picture that is passed on the way is kept, as long as there is room. Where decoding begins
 * at the same picture for the second time, it continues up to the next such picture: so pictures in
 * any order are decoded about twice.
 *
 * Where a part between two such pictures does not fit into half of the cache, it does not continue,
 * and each picture in any order is decoded with those from there up to it.
 *
 * INVARIANT: a picture is found by its time, which ffmpeg reports, and not by counting. A picture
 * that ffmpeg cannot decode, even from the beginning of the file, shows the one before it. What
 * ffmpeg makes of damaged pictures depends on its threads and on what it decoded before: once it
 * has said words, decoding is careful: with one thread, and a worker for each part of the movie,
 * from a place where decoding can begin to the next. Words before the first picture are about those
 * that are shown before it, and need others (an open group of pictures); a worker that says none
 * later may pass from part to part.
 */
#pragma once

#include <pthread.h>

#include "inside/cache.h"
#include "plugins/footage/listing.h"
#include "plugins/footage/raw.h"
#include "plugins/isolate/media.h"

enum { CS_DECODE_TIMES = 1024 };

typedef struct cs_decode {
  const cs_listing *listing; /* borrowed */
  char *path;                /* owned */
  cs_kind_file file;         /* without its descriptor */
  cs_raw planes;
  char pixels[16], decoder[16]; /* names of ffmpeg */
  cs_cache_key key;             /* the key of picture 0 */
  unsigned char *marks;         /* the marks of each picture */
  pthread_mutex_t lock;         /* guards what follows, and the marks */
  struct cs_decode *running;    /* the next one with a worker */
  bool is_running;
  cs_media media;
  size_t next;                    /* the place after the last picture that came */
  size_t begin;                   /* where the worker has begun */
  uint64_t decoded, begun;        /* pictures that came, of all workers, and these */
  int64_t times[CS_DECODE_TIMES]; /* the times of pictures that have not been read; a ring */
  size_t first_time, time_count;
  uint64_t heard; /* messages of the workers */
  cs_words said;  /* the first line that a worker said */
  bool is_said;   /* the line is whole */
  bool has_erred; /* a worker said words */
  bool is_careful;
  bool has_shown, is_sound; /* the worker has shown a picture; it has said no words since then */
} cs_decode;

/* A picture in the cache. */
typedef struct cs_decode_picture {
  cs_cache_entry cached;
  unsigned char *planes;
  size_t size;
} cs_decode_picture;

/* listing: borrowed; it may still be empty. */
void cs_decode_begin(cs_decode *decode, const cs_listing *listing);
/* The listing is complete now. Errors: NO_MEMORY, INPUT. */
CELSPAN_CHECKED celspan_status cs_decode_init(cs_decode *decode, celspan_context *context,
                                              const char *path, const cs_kind_file *file);
void cs_decode_finish(cs_decode *decode, cs_memory *memory);
/* The picture at a place, with a pin, until cs_decode_release. Errors: INPUT, LIMIT, NO_MEMORY,
 * OUTPUT, CANCELLED. */
CELSPAN_CHECKED celspan_status cs_decode_get(cs_decode *decode, celspan_context *context,
                                             size_t place, cs_decode_picture **out);
void cs_decode_release(celspan_context *context, cs_decode_picture *picture);

/* ---- running.c */

/* Ends the worker, if there is one. */
void cs_decode_stop(cs_decode *decode);
/* Notes that a worker runs. Where there are too many, ends the oldest that nobody waits for. */
void cs_decode_note(cs_decode *decode);
