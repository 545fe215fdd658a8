/* Writing files that hold the pictures of a film one after another: AVIF and WebP.
 *
 *   rows of RGBA --moving.c--> whole pictures --avif.c, webp.c--> bytes --put--> the core's file
 *
 * INVARIANT: a file is ended once, by close or by abandon. What was put of a file that failed is
 * not kept by the core.
 */
#pragma once

#include "inside/pictures.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cs_moving cs_moving;

/* The functions of a format, whose state is `self`. Errors: BAD_ARGUMENT, LIMIT, OUTPUT, NO_MEMORY.
 */
typedef struct cs_moving_format {
  const char *name; /* cs_picture_output.format */
  celspan_status (*open)(cs_moving *moving, cs_picture_failure *failure);
  /* Takes the picture in moving->pixels, which it may exchange for another buffer or change. */
  celspan_status (*take)(cs_moving *moving, cs_picture_failure *failure);
  celspan_status (*end)(cs_moving *moving, cs_picture_failure *failure);
  void (*destroy)(void *self);
} cs_moving_format;

struct cs_moving {
  cs_picture_output output; /* without names, which are not kept */
  const cs_moving_format *format;
  void *self;
  char *name, *metadata; /* owned; metadata: in XMP, see cs_moving_open */
  unsigned char *pixels; /* the pixels of the picture whose rows arrive; owned */
  size_t row;            /* bytes */
  int32_t rows;          /* rows that have arrived */
};

/* Whether a file is written by these functions: an AVIF, or a WebP of a film. */
bool cs_moving_has(const cs_picture_output *output);
/* The title and the program's name become metadata of the file. Each sentence begins with the name
 * of the file. */
celspan_status cs_moving_open(const cs_picture_output *output, cs_moving **out,
                              cs_picture_failure *failure);
/* Rows from the top; the row after the last one begins the next picture. */
celspan_status cs_moving_rows(cs_moving *moving, int32_t count, const void *rows,
                              cs_picture_failure *failure);
/* Ends the file, even if it returns an error. */
celspan_status cs_moving_close(cs_moving *moving, cs_picture_failure *failure);
void cs_moving_abandon(cs_moving *moving);

/* ---- for the formats */

celspan_status cs_moving_fail(const cs_moving *moving, cs_picture_failure *failure,
                              celspan_status status, const char *what);
celspan_status cs_moving_put(const cs_moving *moving, uint64_t offset, const void *bytes,
                             size_t size, cs_picture_failure *failure);

extern const cs_moving_format cs_moving_avif, cs_moving_webp;

#ifdef __cplusplus
}
#endif
