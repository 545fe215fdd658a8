/* Noise along a row: its value at the middles of pixels, octave by octave (model/scene/noise.h).
 *
 * An octave is as strong as its cells are large on the film, so that none is finer than the pixels.
 * Of cells and turbulence, which have folds, the limits are higher:
 *
 *     1 |          .-------      strength
 *       |        .
 *     0 |------.
 *       +------+---+-------> a cell's side, pixels
 *              2   4
 *
 * What is left out is replaced by its mean, so the brightness stays. Between the pixels of a row
 * noise is no smooth function, so a program that shows it is painted pixel by pixel.
 */
#pragma once

#include "base/wide.h"
#include "engine/compose/layer.h"

#define CS_NOISE_PLACES 64 /* found at a time */
#define CS_NOISE_LANES 16  /* lanes of the widest register: loops run over multiples of them */

/* Places in the cells of one octave. */
typedef struct cs_noise_places {
  int32_t x[CS_NOISE_PLACES], y[CS_NOISE_PLACES]; /* the cell, modulo 2^32 */
  float u[CS_NOISE_PLACES], v[CS_NOISE_PLACES];   /* the place in it, 0 to 1 */
  int32_t z;
  float w;
  uint32_t seed;
} cs_noise_places;

/* The cells and the places in them of one coordinate, at * scale + shift; in vector code, as what
 * follows. count: a multiple of CS_NOISE_LANES. */
CS_WIDE_DECLARE(void, cs_noise_split,
                (const double *at, int32_t count, double scale, double shift, int32_t *cells,
                 float *places));
/* The value of one octave at each place: about -1 to 1; CELLS: 0 to 1. */
CS_WIDE_DECLARE(void, cs_noise_values,
                (celspan_noise_kind kind, const cs_noise_places *in, int32_t count, float *out));

/* Where the noise of a shade lies along its stops at places of a row, 0 to 1; not a number behind
 * the horizon. */
void cs_noise_at(const cs_shade *shade, const double *x, int32_t count, double y, double *at);
