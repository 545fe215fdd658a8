/* Quads of texels that are read as codes, and decoded in registers: that is quicker than fetching
 * four times as many bytes of light.
 *
 *     +----------+----------+----------+     tiles: the blocks of 64 x 64 codes in the rectangle
 *     |::        |          |          |     around a batch of pixels, numbered row by row
 *     |    ::    |  tile 1  |  tile 2  |
 *     | tile 0 ::|          |          |     ::  the quad of a pixel; in a row of the frame the
 *     +----------+-::-------+----------+         pixels lie along a straight line
 *     |          |     ::   |          |
 *     |  tile 3  |  tile 4 :|:         |     only the tiles that quads touch are read, here 0, 1,
 *     |          |          |  :: 5    |     4 and 5
 *     +----------+----------+----------+
 */
#pragma once

#include "engine/sample/sampler_texel.h"

#define CS_SAMPLER_TILES 16

/* The rectangle of blocks of level 0 that lies under some pixels. */
typedef struct cs_sampler_tiles {
  int32_t column, row, columns;                 /* its first block, and its width in blocks */
  bool are_opaque;                              /* all blocks that are touched are opaque */
  const unsigned char *codes[CS_SAMPLER_TILES]; /* the codes of the tiles that are touched */
  /* Bytes from a quad's codes to those that the row after the next will read: they are fetched into
   * the cache now, so that they are there in time. */
  ptrdiff_t ahead;
} cs_sampler_tiles;

/* Quads clamped to the picture; a quad at an edge has the share 0 of the texels beyond it. */
typedef struct cs_sampler_clamped {
  int32_t x[CS_SAMPLER_BATCH], y[CS_SAMPLER_BATCH];
  float across[CS_SAMPLER_BATCH], down[CS_SAMPLER_BATCH];
  int32_t left, top, right, bottom; /* the least and the greatest x and y */
  /* Where the codes of the upper and of the lower pair of texels are: tile << 16 | bytes. */
  int32_t above[CS_SAMPLER_BATCH], below[CS_SAMPLER_BATCH];
} cs_sampler_clamped;

/* Finds the tiles around some quads; false if there are too many. */
static inline bool cs_sampler_lay_tiles(const cs_sampler *sampler,
                                        const cs_sampler_clamped *clamped,
                                        cs_sampler_tiles *tiles) {
  int32_t bottom = clamped->bottom + (clamped->bottom + 1 < sampler->height);
  tiles->column = clamped->left / CS_PICTURE_BLOCK;
  tiles->row = clamped->top / CS_PICTURE_BLOCK;
  tiles->columns = clamped->right / CS_PICTURE_BLOCK - tiles->column + 1;
  int64_t rows = bottom / CS_PICTURE_BLOCK - tiles->row + 1;
  return rows * tiles->columns <= CS_SAMPLER_TILES;
}

/* ---- sampler_codes_wide.c: loops over `count` pixels */

/* Fills x, y and the shares, and the bounds. */
CS_WIDE_DECLARE(void, cs_sampler_clamp_quads,
                (const cs_sampler *sampler, int32_t count, const double *u, const double *v,
                 cs_sampler_clamped *clamped));
/* Fills above and below. Returns a bit for each tile: whether it is touched. */
CS_WIDE_DECLARE(uint32_t, cs_sampler_tile_quads,
                (const cs_sampler *sampler, const cs_sampler_tiles *tiles, int32_t count,
                 cs_sampler_clamped *clamped));
/* The same for the centres of an affine map whose quads all lie in the picture; fills the shares,
 * too. */
CS_WIDE_DECLARE(uint32_t, cs_sampler_place_quads,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y,
                 const cs_sampler_tiles *tiles, cs_sampler_clamped *clamped));
/* Mixes quads of codes. In planes: only with cs_srgb8_decodes, and `count` is of whole planes. */
CS_WIDE_DECLARE(void, cs_sampler_mix_codes,
                (const cs_srgb8_curve *curve, const cs_sampler_tiles *tiles,
                 const cs_sampler_clamped *clamped, int32_t count, bool are_planes,
                 float (*rgba)[4]));
/* The texels of `count` codes that follow one another. */
CS_WIDE_DECLARE(void, cs_sampler_decode_codes,
                (const cs_srgb8_curve *curve, const unsigned char *codes, int32_t count,
                 float (*rgba)[4]));
/* The same in planes: only with cs_srgb8_decodes, and `count` is of whole planes. */
CS_WIDE_DECLARE(void, cs_sampler_decode_planes,
                (const cs_srgb8_curve *curve, const unsigned char *codes, int32_t count,
                 float (*planes)[4]));
