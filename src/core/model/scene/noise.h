/* Noise: what a texture of noise is made of, for all who evaluate it.
 *
 * The plane is cut into cells, once for each octave; an octave's cells have half the side of those
 * of the octave before. `at` is a third coordinate. Every corner of a cell (PERLIN, VALUE), or
 * every cell (CELLS, WHITE), has a word of 32 bits, mixed from its three whole coordinates and the
 * octave's seed:
 *
 *     word = lowbias32(x 0x9e3779b1 ^ y 0x85ebca77 ^ z 0xc2b2ae3d ^ seed)
 *
 * PERLIN    bit 31: the gradient leans along y, else along x; bits 30, 29, 28: the signs of its x,
 *           y and z. In the plane it has the length of sqrt 2, in eight directions, so that values
 *           lie in -1..1 for a whole `at`; along z it has the length of 1.
 * VALUE     the word as a number from -1 to 1.
 * CELLS     a point in the cell: x and y are its upper and lower 16 bits, z the upper 16 bits of
 *           the word times 0x9e3779b1.
 * WHITE     the word as a number from -1 to 1, the same in all of a cell. Cells are not moved.
 * Between corners values are mixed by t^3 (6 t^2 - 15 t + 10).
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "celspan/celspan.h"

#define CS_NOISE_OCTAVES 16      /* at most */
#define CS_NOISE_FARTHEST 0x1p50 /* cells from the origin; farther points are moved there */

#define CS_NOISE_X UINT32_C(0x9e3779b1)
#define CS_NOISE_Y UINT32_C(0x85ebca77)
#define CS_NOISE_Z UINT32_C(0xc2b2ae3d)
/* Parts of a Perlin gradient in the plane: sqrt 2 times the cosine and the sine of 22.5 degrees. */
#define CS_NOISE_LONG 1.3065629648763766
#define CS_NOISE_SHORT 0.541196100146197

typedef struct cs_noise {
  celspan_noise_kind kind;
  double size; /* side of a cell of the first octave, own units; above 0 */
  int octaves; /* 1 for kinds that have one */
  double gain;
  int seed;
  double at;  /* cells of the first octave */
  bool fades; /* octaves that are finer than pixels fade */
} cs_noise;

/* One octave of a noise: its cells are the first octave's times `scale`, then moved. */
typedef struct cs_noise_octave {
  double scale, shift_x, shift_y;
  uint32_t seed;
} cs_noise_octave;

cs_noise_octave cs_noise_octave_of(const cs_noise *noise, int index);
