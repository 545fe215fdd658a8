/* Pictures at an angle or in perspective: the mean of taps spread over the pixel.
 *
 *     frame: a pixel                  picture: its footprint, a parallelogram
 *     +-----------+                          +-----------+
 *     | *   *   * |       inverse           / *   *   * /
 *     |           |    ------------>       /           /
 *     | *   *   * |                       / *   *   * /
 *     +-----------+                      +-----------+
 *     3 x 2 taps, marked *
 *
 * The value of a tap is mixed from the four texels about it, a quad:
 *
 *     texel (x, y) o-----:-----o (x + 1, y)
 *                  |     :     |             across: the share of the two texels on the right
 *                  |.....*.....|             down: the share of the two texels below
 *                  |     :     |
 *                  o-----:-----o             o: the centre of a texel
 *
 *   centres of pixels --moved by a tap--> quads of texels --by stretches in one block--> mixes
 */
#pragma once

#include "engine/sample/sampler_texel.h"

void cs_sampler_taps_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]);
/* Makes at most CS_SAMPLER_BATCH pixels as planes. Returns false if that is not possible: it needs
 * one tap for each pixel, and all taps inside the picture. */
bool cs_sampler_taps_planes(const cs_sampling *run, cs_run pixels, float (*planes)[4]);

/* Where the centres of a batch of pixels lie on the picture. */
typedef struct cs_sampler_centres {
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  double near[CS_SAMPLER_BATCH];     /* 1 / w; 0 at and behind the horizon, where u and v are 0 */
  bool all_visible;                  /* all are visible, and `visible` is not filled */
  int32_t visible[CS_SAMPLER_BATCH]; /* 0: the pixel is clear */
} cs_sampler_centres;

/* The quads of texels that taps mix. */
typedef struct cs_sampler_quads {
  int32_t x[CS_SAMPLER_BATCH], y[CS_SAMPLER_BATCH];
  float across[CS_SAMPLER_BATCH], down[CS_SAMPLER_BATCH];
  /* names the block that holds all four texels; -1: no block holds them all */
  int32_t key[CS_SAMPLER_BATCH];
  int32_t offset[CS_SAMPLER_BATCH]; /* from the block to the first texel of the quad, in texels */
} cs_sampler_quads;

/* A tap's place in its pixel, relative to the pixel's centre, in pixels of the frame. */
typedef struct cs_sampler_tap {
  double x, y;
} cs_sampler_tap;

/* ---- sampler_taps_wide.c: loops over `count` pixels */

/* The centres of an affine map. */
CS_WIDE_DECLARE(void, cs_sampler_map_affine,
                (const double m[9], int32_t x0, int32_t count, double y,
                 cs_sampler_centres *centres));
CS_WIDE_DECLARE(void, cs_sampler_map_perspective,
                (const double m[9], int32_t x0, int32_t count, double y,
                 cs_sampler_centres *centres));
/* Fills `visible`. */
CS_WIDE_DECLARE(void, cs_sampler_mark_visible,
                (const cs_sampler *sampler, int32_t count, cs_sampler_centres *centres));
/* In perspective, the texels in each pixel's mean: level << 16 | columns << 8 | rows. */
CS_WIDE_DECLARE(void, cs_sampler_plan_taps,
                (const cs_sampler *sampler, int32_t count, const cs_sampler_centres *centres,
                 int32_t *plans));
/* The places of one tap for the pixels from number `from` on. Unless the picture repeats they are
 * clamped to places whose quads have numbers that fit into an int32_t. */
CS_WIDE_DECLARE(void, cs_sampler_move,
                (const cs_sampler *sampler, cs_sampler_tap tap, int32_t from, int32_t count,
                 const cs_sampler_centres *centres, double *u, double *v));
/* cs_sampler_map_affine and cs_sampler_move in one, for one tap a pixel at its centre; only for
 * pictures that do not repeat. */
CS_WIDE_DECLARE(void, cs_sampler_place_taps,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y, double *u,
                 double *v));
CS_WIDE_DECLARE(void, cs_sampler_find_quads,
                (const cs_sampler *sampler, int level, int32_t count, const double *u,
                 const double *v, cs_sampler_quads *quads));
/* Mixes the quads [from, from + count), all of them in the block. ahead: bytes from a quad to the
 * place in the block that the row after the next will read; it is fetched into the cache now, so
 * that it is there in time. */
CS_WIDE_DECLARE(void, cs_sampler_mix_quads,
                (const float *block, const cs_sampler_quads *quads, int32_t from, int32_t count,
                 ptrdiff_t ahead, float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_sampler_clear_invisible,
                (const int32_t *visible, int32_t count, float (*rgba)[4]));
