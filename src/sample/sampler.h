/* Pictures along a row: inverse mapping of pixel centres to texels, filtered.
 *
 * A pixel gets one sample at its centre: the texel itself at whole-pixel placement and scale 1 (bit
 * exact), interpolation when enlarged (Catmull-Rom for bicubic), the average in linear light over
 * the pixel's footprint when shrunk: exact up to a factor of 8 while rows stay rows or columns,
 * from mip levels beyond, and by up to 16 taps an axis where the footprint is tilted. The footprint
 * is that of the pixel's parallelogram under the inverse map, so rotation, unequal scaling and
 * perspective are right too. Nearest is the texel under the centre, bilinear the mix of the four
 * texels about it, at any scale.
 *
 * CLEAR makes pixels whose centre lies outside the picture clear; inside, what a kernel wants
 * beyond the edge is the edge's, so a picture gets no soft border of its own.
 *
 * The samples of a run depend on the pixel and the maps alone, never on where the run begins, nor
 * on the instructions that make them.
 */
#ifndef CS_SAMPLE_SAMPLER_H
#define CS_SAMPLE_SAMPLER_H

#include "base/wide.h"
#include "geometry/matrix.h"
#include "pictures/block_cache.h"

/* How samples are taken, by how the picture lies. */
typedef enum cs_sampler_way {
  CS_SAMPLER_COPY,        /* whole-pixel placement at scale 1: the texels themselves */
  CS_SAMPLER_ROW,         /* rows stay rows: a row of texels is made first, then looked up */
  CS_SAMPLER_TAPS,        /* affine: the mean of taps spread over the pixel */
  CS_SAMPLER_PERSPECTIVE, /* likewise, but how many taps differs from pixel to pixel */
  CS_SAMPLER_PIXEL        /* one by one: Catmull-Rom, and means where rows become columns */
} cs_sampler_way;

typedef enum cs_sampler_kernel {
  CS_SAMPLER_NEAREST,
  CS_SAMPLER_LINEAR, /* the four texels about the centre */
  CS_SAMPLER_CUBIC,
  CS_SAMPLER_BOX, /* the exact mean, of a footprint with sides along those of the picture */
  CS_SAMPLER_TILTED
} cs_sampler_kernel;

typedef struct cs_sampler {
  const cs_picture *picture;
  celspan_matrix
      inverse;           /* frame pixels to picture pixels (texel i covers [i, i+1)), homogeneous */
  int32_t width, height; /* of the picture */
  celspan_sampling sampling;
  celspan_wrap wrap;
  cs_isa isa; /* that its samples are taken with */

  /* filled in by cs_sampler_prepare */
  cs_block_cache_source source;
  cs_sampler_way way;
  cs_sampler_kernel
      kernel;  /* PERSPECTIVE: CUBIC and TILTED where the picture is enlarged and shrunk */
  double m[9]; /* inverse; where it is affine divided by its last */
  int level_count;
  int level;
  int columns, rows;    /* TILTED: taps across a pixel and down it */
  int32_t look_columns; /* that are worth a look at a time; INT32_MAX: none tells anything */
  bool reads_codes;     /* of blocks that are coded: they are decoded in registers */
  double reach; /* affine: how far from its centre a sample comes, at most, in picture pixels */
  double wide, high; /* BOX: the sides of the footprint, in picture pixels */
} cs_sampler;

/* Decides how samples are taken. */
void cs_sampler_prepare(cs_sampler *sampler);

/* Premultiplied linear RGBA of the pixels x0 .. x0+count-1 on the row whose centre is at height y
 * (pixels). A pixel at or behind the horizon is clear. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sampler_run(cs_block_cache *texels, const cs_sampler *sampler,
                                              int32_t x0, int32_t count, double y,
                                              float (*rgba)[4]);
/* The same of some columns, ascending. */
CELSPAN_CHECKED celspan_status cs_sampler_at(cs_block_cache *texels, const cs_sampler *sampler,
                                             const int32_t *columns, int32_t count, double y,
                                             float (*rgba)[4]);

/* A picture that is copied: the codes of its texels (cs_picture_block), 4 bytes a pixel. */
CELSPAN_CHECKED celspan_status cs_sampler_codes(cs_block_cache *texels, const cs_sampler *sampler,
                                                int32_t x0, int32_t count, double y,
                                                unsigned char *codes);
/* What the samples of the pixels [x0, x1) are known to have in common; MIXED where it is not known.
 */
CELSPAN_CHECKED celspan_status cs_sampler_look(cs_block_cache *texels, const cs_sampler *sampler,
                                               int32_t x0, int32_t x1, double y,
                                               cs_picture_opacity *out);

/* Whether texels are some pixels wide and stand upright, so that a row of them is worth a span
 * each: of one colour (nearest), or straight from centre to centre. */
bool cs_sampler_is_grid(const cs_sampler *sampler);
/* Of a grid: the columns inside (x0, x1) at which such spans begin, ascending; at most as many as
 * the limit says. Returns how many. */
size_t cs_sampler_steps(const cs_sampler *sampler, int32_t x0, int32_t x1, double y,
                        int32_t *columns);
size_t cs_sampler_step_limit(const cs_sampler *sampler, int32_t x0, int32_t x1);

#endif
