/* A picture that is read to be relit: its pixels in linear light, premultiplied, some rows at a
 * time.
 *
 *   texture --> picture --pictures/load.h--> blocks of 64 x 64 --> 64 rows of RGBA floats
 *
 * INVARIANT: `rows` holds the rows from `first` on that lie in the picture, CS_ORIGINAL_ROWS at
 * most.
 */
#pragma once

#include "inside/pictures.h"
#include "inside/scene.h"

#define CS_ORIGINAL_ROWS CS_PICTURE_BLOCK
/* The most pixels of a picture. */
#define CS_ORIGINAL_MOST 268435456

typedef struct cs_original {
  const cs_picture *picture; /* borrowed */
  celspan_picture_info info;
  float *rows; /* width x CS_ORIGINAL_ROWS pixels */
  int32_t first;
} cs_original;

/* Opens the picture of a texture. noun: the first word of error messages. Errors: those of
 * pictures; BAD_ARGUMENT unless the texture is a picture that is used as paint; LIMIT; NO_MEMORY.
 * On failure there is nothing to close. */
CELSPAN_CHECKED celspan_status cs_original_open(celspan_context *context, const char *noun,
                                                const celspan_texture *texture, cs_original *out);
/* Opens a known picture. Errors: those of pictures; LIMIT; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_original_open_picture(celspan_context *context,
                                                        const cs_picture *picture,
                                                        cs_original *out);
/* Reads the rows from `first` on, a multiple of CS_ORIGINAL_ROWS. Errors: those of pictures. */
CELSPAN_CHECKED celspan_status cs_original_read(celspan_context *context, cs_original *original,
                                                int32_t first);
void cs_original_close(celspan_context *context, cs_original *original);
/* Refuses pictures of different sizes. */
CELSPAN_CHECKED celspan_status cs_original_same_size(celspan_context *context, const cs_original *a,
                                                     const cs_original *b);

/* A pixel of the rows that were read. */
static inline const float *cs_original_at(const cs_original *original, int32_t x, int32_t y) {
  return original->rows +
         4 * ((size_t)(y - original->first) * (size_t)original->info.width + (size_t)x);
}

/* The end of the rows that were read from `first` on. */
static inline int32_t cs_original_end(const cs_original *original, int32_t first) {
  int32_t rest = original->info.height - first;
  return first + (rest < CS_ORIGINAL_ROWS ? rest : CS_ORIGINAL_ROWS);
}

/* The result when light has been taken off: the pixels of a texture with S, T and beta of its own.
 *
 *   create --> pixels are written --> finish: two surfaces, shown by one texture
 *      \------------------------------ discard
 *
 *   paint    S in red, green and blue, beta in alpha        16 bytes a pixel
 *   medium   T in red, green and blue, 1 in alpha           likewise; NULL: T is 1 - beta
 *
 * INVARIANT: what was created is ended once, by finish, whatever it returns, or by discard.
 */

typedef struct cs_unlit {
  int32_t width, height;
  float *paint, *medium;
} cs_unlit;

/* Errors: NO_MEMORY; BAD_ARGUMENT, LIMIT for the size. */
CELSPAN_CHECKED celspan_status cs_unlit_create(celspan_context *context, int32_t width,
                                               int32_t height, bool has_medium, cs_unlit *out);
void cs_unlit_discard(celspan_context *context, cs_unlit *unlit);
/* like: NULL, or a picture from which the texture gets sampling, wrap and box. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_unlit_finish(celspan_context *context, cs_unlit *unlit,
                                               const celspan_texture *like, celspan_texture **out);

static inline float *cs_unlit_paint(const cs_unlit *unlit, int32_t x, int32_t y) {
  return unlit->paint + 4 * ((size_t)y * (size_t)unlit->width + (size_t)x);
}

static inline float *cs_unlit_medium(const cs_unlit *unlit, int32_t x, int32_t y) {
  return unlit->medium + 4 * ((size_t)y * (size_t)unlit->width + (size_t)x);
}
