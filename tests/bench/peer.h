/* A peer of the benchmark: one renderer behind these functions, linked with peer.c.
 *
 * Shapes are drawn band by band into one band of memory that is reused, as a program would do that
 * wants a large picture. The frames of a film are drawn into one whole picture that is reused: the
 * paths are built once, and each frame draws them under its own matrix.
 */
#pragma once

#include <stdbool.h>

#include "drawing.h"
#include "film.h"
#include "pictures.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bench_peer {
  bool is_bgra; /* the order of channels in memory, else RGBA */
  /* Builds the paths at full size. */
  void *(*begin)(const bench_drawing *drawing, int side, bool is_antialiased);
  /* Clears a band to white and draws the shapes that meet it. */
  void (*band)(void *frame, uint8_t *pixels, int width, int rows, int first_row);
  /* Draws the shapes over what a picture of these sides shows, in their place in sides of the
   * picture that `begin` was given. */
  void (*place)(void *frame, uint8_t *pixels, int side, bench_place place);
  void (*end)(void *frame);
  /* Draws a raster job into a frame; NULL: the peer has none. */
  void (*picture)(const bench_job *job, uint8_t *frame);
  /* Which jobs it can do. */
  bool has_perspective;
} bench_peer;

extern const bench_peer bench_peer_here;

/* Whether a shape can be seen in these rows of a picture of this side. */
static inline bool bench_shape_meets(const bench_shape *shape, double side, double first_row,
                                     int rows) {
  return shape->bottom * side >= first_row - 1 && shape->top * side <= first_row + rows + 1;
}

#ifdef __cplusplus
}
#endif
