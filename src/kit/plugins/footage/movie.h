/* Movies: files whose pictures are shown as surfaces.
 *
 *   file --listing.h--> times of all pictures
 *        --decode.h---> raw pictures, in a cache --raw.h--> R'G'B' codes of a surface
 *
 * INVARIANT: a picture of a movie is a function of the file and of its place in the order in which
 * pictures are shown, whatever was decoded before. A file that has changed since it was opened is
 * an error.
 *
 * Threads: any, one of them decoding at a time.
 */
#pragma once

#include "inside/hash.h"
#include "plugins/footage/decode.h"

typedef struct cs_movie {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash; /* the hash of the file's name and state */
  cs_listing listing;
  cs_decode decode;
} cs_movie;

/* tried: another path that does not exist either, or NULL. Errors: INPUT, LIMIT, NO_MEMORY; OUTPUT,
 * if there is no ffmpeg; CANCELLED. */
CELSPAN_CHECKED celspan_status cs_movie_open(celspan_context *context, const char *path,
                                             const char *tried, cs_movie **out);
cs_movie *cs_movie_ref(cs_movie *movie);
void cs_movie_unref(cs_movie *movie);
/* The picture at a place, from 0, as a surface that decodes it when it is seen. */
CELSPAN_CHECKED celspan_status cs_movie_surface(celspan_context *context, cs_movie *movie,
                                                size_t place, celspan_alpha alpha,
                                                celspan_surface **out);
