/* What is left when light has been taken off: the pixels of a texture of its own S, T and beta.
 *
 *   create --> pixels are written --> finish: two surfaces, shown by one texture
 *      \------------------------------ discard
 *
 *   paint    S in red, green and blue, beta in alpha        16 bytes a pixel
 *   medium   T in red, green and blue, 1 in alpha           likewise; NULL: T is 1 - beta
 *
 * INVARIANT: what was created is ended once, by finish, whatever it returns, or by discard.
 */
#ifndef CS_RELIGHT_UNLIT_H
#define CS_RELIGHT_UNLIT_H

#include "scene/texture.h"

typedef struct cs_unlit {
  int32_t width, height;
  float *paint, *medium;
} cs_unlit;

/* Errors: NO_MEMORY; BAD_ARGUMENT, LIMIT for the size. */
CELSPAN_CHECKED celspan_status cs_unlit_create(celspan_context *context, int32_t width,
                                               int32_t height, bool has_medium, cs_unlit *out);
void cs_unlit_discard(celspan_context *context, cs_unlit *unlit);
/* like: NULL, or a picture whose sampling, wrap and box the texture gets. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_unlit_finish(celspan_context *context, cs_unlit *unlit,
                                               const celspan_texture *like, celspan_texture **out);

static inline float *cs_unlit_paint(const cs_unlit *unlit, int32_t x, int32_t y) {
  return unlit->paint + 4 * ((size_t)y * (size_t)unlit->width + (size_t)x);
}

static inline float *cs_unlit_medium(const cs_unlit *unlit, int32_t x, int32_t y) {
  return unlit->medium + 4 * ((size_t)y * (size_t)unlit->width + (size_t)x);
}

#endif
