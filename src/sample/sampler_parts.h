/* What the files of the sampler share.
 *
 *   sampler.c        which way, and copies
 *   sampler_row.c    pictures whose rows stay rows
 *   sampler_grid.c   where their texels begin, when these are wide
 *   sampler_taps.c   all others, many pixels at a time
 *   sampler_pixel.c  kernels that are taken one by one
 *   sampler_look.c   what samples have in common, by the blocks of texels they come from
 *   sampler_wide.c   the loops over pixels, compiled for every set of instructions
 *   sampler_codes_wide.c   those over texels that are coded
 *
 * All sums are taken about one texel, so a constant picture stays what it is to the bit.
 */
#ifndef CS_SAMPLE_SAMPLER_PARTS_H
#define CS_SAMPLE_SAMPLER_PARTS_H

#include <math.h>

#include "base/number.h"
#include "base/vector.h"
#include "pictures/levels.h"
#include "sample/sampler.h"

/* Of a texel: closer is the same place. Matrices carry rounding, pictures have 2^20 pixels. */
#define CS_SAMPLER_SAME 1e-6

/* Texels of the chosen level across the shorter side of a footprint: at least so many, and less
 * than twice that. More are exacter at the edges of a footprint, and slower. */
#define CS_SAMPLER_BOX_TEXELS 4
#define CS_SAMPLER_TAP_TEXELS 2
#define CS_SAMPLER_MOST_BOX 64
#define CS_SAMPLER_MOST_TAPS 16

#define CS_SAMPLER_BATCH 256 /* pixels */

typedef struct cs_sampling {
  const cs_sampler *sampler;
  cs_block_cache *texels;
} cs_sampling;

/* ---- places */

/* floor of what fits, without a call. */
static inline int32_t cs_sampler_floor(double x) {
  int32_t whole = (int32_t)x;
  return whole - (x < whole);
}

static inline int32_t cs_sampler_wrap(int32_t i, int32_t size, celspan_wrap mode) {
  if (i >= 0 && i < size)
    return i;
  if (mode != CELSPAN_WRAP_REPEAT)
    return i < 0 ? 0 : size - 1;
  int32_t rest = i % size;
  return rest < 0 ? rest + size : rest;
}

/* A repeated picture is sampled near its own origin, so far tiles cost no precision. Afterwards a
 * coordinate fits an int32_t. */
static inline double cs_sampler_home(double u, int32_t size, celspan_wrap mode) {
  if (u >= 0 && u < size)
    return u;
  return mode == CELSPAN_WRAP_REPEAT ? u - floor(u / size) * size : cs_number_clamp(u, -1e9, 1e9);
}

/* Whether a centre leaves its pixel clear, along one axis. */
static inline bool cs_sampler_is_outside(double u, int32_t size, celspan_wrap mode) {
  return mode == CELSPAN_WRAP_CLEAR && !(u >= -CS_SAMPLER_SAME && u < size - CS_SAMPLER_SAME);
}

/* The texel left of or at u - 1/2 and the share of its right neighbour. */
static inline int32_t cs_sampler_split(double u, float *share) {
  int32_t left = cs_sampler_floor(u - 0.5 + CS_SAMPLER_SAME);
  double rest = u - 0.5 - left;
  *share = rest < CS_SAMPLER_SAME ? 0.0f : (float)rest;
  return left;
}

/* A wrapped texel. */
static inline const float *cs_sampling_texel(const cs_sampling *run, int level, int32_t x,
                                             int32_t y) {
  const cs_sampler *s = run->sampler;
  return cs_block_cache_at(run->texels, &s->source, level,
                           cs_sampler_wrap(x, cs_levels_size(s->width, level), s->wrap),
                           cs_sampler_wrap(y, cs_levels_size(s->height, level), s->wrap));
}

/* Where a row stays a row: the centre of a column, and the height. */
static inline double cs_sampler_row_u(const cs_sampler *s, int32_t column, double y) {
  return s->m[0] * ((double)column + 0.5) + (s->m[1] * y + s->m[2]);
}

static inline double cs_sampler_row_v(const cs_sampler *s, double y) {
  return s->m[4] * y + s->m[5];
}

/* ---- the parts: rgba has room for `count` pixels from x0 on */

void cs_sampler_row_run(const cs_sampling *run, int32_t x0, int32_t count, double y,
                        float (*rgba)[4]);
void cs_sampler_row_at(const cs_sampling *run, const int32_t *columns, int32_t count, double y,
                       float (*rgba)[4]);
void cs_sampler_taps_run(const cs_sampling *run, int32_t x0, int32_t count, double y,
                         float (*rgba)[4]);
void cs_sampler_pixel_run(const cs_sampling *run, int32_t x0, int32_t count, double y,
                          float (*rgba)[4]);
/* One sample at home, inside the picture. */
void cs_sampler_cubic(const cs_sampling *run, double u, double v, float rgba[4]);

/* One axis of a box at a level: texels and how many pixels of each it covers. */
typedef struct cs_extent {
  int32_t first, count;
  float weights[2 * CS_SAMPLER_MOST_BOX + 4];
} cs_extent;

void cs_sampler_cut_extent(const cs_sampler *sampler, double centre, double width, int32_t size,
                           cs_extent *out);
/* The level at which `shorter` is `texels` or more, or a higher one if `longer` is too long there.
 */
int cs_sampler_level(int level_count, double shorter, double longer, double texels, double most);

/* Whether codes are decoded in registers, which is quicker than to fetch four times as much. */
static inline bool cs_sampler_decodes(cs_isa isa) {
#ifdef __x86_64__
  return isa == CS_ISA_AVX512 && __builtin_cpu_supports("avx512vbmi");
#else
  return false;
#endif
}

/* ---- sampler_wide.c, sampler_codes_wide.c: loops over `count` pixels */

/* Where the centres of pixels lie on the picture. */
typedef struct cs_sampler_centres {
  double u[CS_SAMPLER_BATCH], v[CS_SAMPLER_BATCH];
  double near[CS_SAMPLER_BATCH];  /* 1 / w; 0 at and behind the horizon, where u and v are 0 */
  bool all_seen;                  /* and `seen` is not filled */
  int32_t seen[CS_SAMPLER_BATCH]; /* 0: the pixel is clear */
} cs_sampler_centres;

/* The quads of texels that taps mix. */
typedef struct cs_sampler_quads {
  int32_t x[CS_SAMPLER_BATCH], y[CS_SAMPLER_BATCH];
  float across[CS_SAMPLER_BATCH], down[CS_SAMPLER_BATCH];
  int32_t key[CS_SAMPLER_BATCH];    /* of the block that holds all four; -1 where none does */
  int32_t offset[CS_SAMPLER_BATCH]; /* of the first in it, in texels */
} cs_sampler_quads;

#define CS_SAMPLER_TILES 16

/* Coded blocks of level 0 that lie under some pixels: so many columns, from a block on. */
typedef struct cs_sampler_tiles {
  int32_t column, row, columns;
  bool are_opaque;                              /* those that are touched */
  const unsigned char *codes[CS_SAMPLER_TILES]; /* of those that are touched */
} cs_sampler_tiles;

/* Quads held to the picture: beyond an edge their share is 0. */
typedef struct cs_sampler_held {
  int32_t x[CS_SAMPLER_BATCH], y[CS_SAMPLER_BATCH];
  float across[CS_SAMPLER_BATCH], down[CS_SAMPLER_BATCH];
  int32_t left, top, right, bottom; /* the least and the greatest x and y */
  /* Where the codes of its upper and lower pair are: tile << 16 | bytes. */
  int32_t above[CS_SAMPLER_BATCH], below[CS_SAMPLER_BATCH];
} cs_sampler_held;

/* False if they are too many. */
static inline bool cs_sampler_lay_tiles(const cs_sampler *sampler, const cs_sampler_held *held,
                                        cs_sampler_tiles *tiles) {
  int32_t bottom = held->bottom + (held->bottom + 1 < sampler->height);
  tiles->column = held->left / CS_PICTURE_BLOCK;
  tiles->row = held->top / CS_PICTURE_BLOCK;
  tiles->columns = held->right / CS_PICTURE_BLOCK - tiles->column + 1;
  int64_t rows = bottom / CS_PICTURE_BLOCK - tiles->row + 1;
  return rows * tiles->columns <= CS_SAMPLER_TILES;
}

/* Where taps are on the picture, relative to a pixel's centre, in pixels of the frame. */
typedef struct cs_sampler_tap {
  double x, y;
} cs_sampler_tap;

/* The centres of an affine map. */
CS_WIDE_DECLARE(void, cs_sampler_map_affine,
                (const double m[9], int32_t x0, int32_t count, double y,
                 cs_sampler_centres *centres));
CS_WIDE_DECLARE(void, cs_sampler_map_perspective,
                (const double m[9], int32_t x0, int32_t count, double y,
                 cs_sampler_centres *centres));
/* Fills seen. */
CS_WIDE_DECLARE(void, cs_sampler_see,
                (const cs_sampler *sampler, int32_t count, cs_sampler_centres *centres));
/* In perspective, what each pixel's mean is made of: level << 16 | columns << 8 | rows. */
CS_WIDE_DECLARE(void, cs_sampler_plan_taps,
                (const cs_sampler *sampler, int32_t count, const cs_sampler_centres *centres,
                 int32_t *plans));
/* The centres of pixels `from` on moved by a tap: where it is, held to what fits unless the picture
 * repeats. */
CS_WIDE_DECLARE(void, cs_sampler_move,
                (const cs_sampler *sampler, cs_sampler_tap tap, int32_t from, int32_t count,
                 const cs_sampler_centres *centres, double *u, double *v));
/* The centres of an affine map as taps at once, where the picture does not repeat. */
CS_WIDE_DECLARE(void, cs_sampler_place_taps,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y, double *u,
                 double *v));
CS_WIDE_DECLARE(void, cs_sampler_find_quads,
                (const cs_sampler *sampler, int level, int32_t count, const double *u,
                 const double *v, cs_sampler_quads *quads));
/* Those of quads [from, from + count), all in the block. ahead: bytes from a quad to where the row
 * after the next will read, if it is in the block: fetched now, it is there in time. */
CS_WIDE_DECLARE(void, cs_sampler_mix_quads,
                (const float *block, const cs_sampler_quads *quads, int32_t from, int32_t count,
                 ptrdiff_t ahead, float (*rgba)[4]));
/* Fills x, y and the shares, and the bounds. */
CS_WIDE_DECLARE(void, cs_sampler_hold_quads,
                (const cs_sampler *sampler, int32_t count, const double *u, const double *v,
                 cs_sampler_held *held));
/* Fills above and below; returns a bit each of the tiles that are touched. */
CS_WIDE_DECLARE(uint32_t, cs_sampler_tile_quads,
                (const cs_sampler *sampler, const cs_sampler_tiles *tiles, int32_t count,
                 cs_sampler_held *held));
/* The same, and the shares, of the centres of an affine map, where all quads lie in the picture. */
CS_WIDE_DECLARE(uint32_t, cs_sampler_place_quads,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y,
                 const cs_sampler_tiles *tiles, cs_sampler_held *held));
/* ahead: bytes. */
CS_WIDE_DECLARE(void, cs_sampler_mix_codes,
                (const cs_srgb8_curve *curve, const cs_sampler_tiles *tiles,
                 const cs_sampler_held *held, int32_t count, ptrdiff_t ahead, float (*rgba)[4]));
/* The texels of `count` codes that follow one another. */
CS_WIDE_DECLARE(void, cs_sampler_decode_codes,
                (const cs_srgb8_curve *curve, const unsigned char *codes, int32_t count,
                 float (*rgba)[4]));
/* out = a + share (b - a); out may be a. */
CS_WIDE_DECLARE(void, cs_sampler_mix_rows,
                (const float (*a)[4], const float (*b)[4], float share, int32_t count,
                 float (*out)[4]));
/* sum += weight (texels - first) */
CS_WIDE_DECLARE(void, cs_sampler_add_row,
                (const float (*texels)[4], const float (*first)[4], float weight, int32_t count,
                 float (*sum)[4]));
/* sum = first + sum / total */
CS_WIDE_DECLARE(void, cs_sampler_end_sum,
                (const float (*first)[4], float total, int32_t count, float (*sum)[4]));
/* Where the centres of a row's columns lie. */
CS_WIDE_DECLARE(void, cs_sampler_place_row,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y, double *u));
CS_WIDE_DECLARE(void, cs_sampler_place_columns,
                (const cs_sampler *sampler, const int32_t *columns, int32_t count, double y,
                 double *u));
/* As cs_sampler_home, for pictures that do not repeat. */
CS_WIDE_DECLARE(void, cs_sampler_hold_row, (int32_t count, double *u));
/* The texels under the centres. */
CS_WIDE_DECLARE(void, cs_sampler_floor_row, (const double *u, int32_t count, int32_t *at));
/* The texels left of or at u - 1/2, and the shares of their right neighbours. */
CS_WIDE_DECLARE(void, cs_sampler_split_row,
                (const double *u, int32_t count, int32_t *at, float *across));
/* Between texels[at[i] - first] and the next. */
CS_WIDE_DECLARE(void, cs_sampler_mix_along,
                (const float (*texels)[4], int32_t first, const int32_t *at, const float *across,
                 int32_t count, float (*rgba)[4]));
CS_WIDE_DECLARE(void, cs_sampler_clear_unseen,
                (const int32_t *seen, int32_t count, float (*rgba)[4]));

#endif
