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
#include "span/run.h"

/* How the picture lies on the frame, which decides how samples are made. */
typedef enum cs_sampler_placement {
  CS_SAMPLER_COPY,        /* moved by whole pixels, at scale 1: the texels themselves */
  CS_SAMPLER_UPRIGHT,     /* rows stay rows: a line of texels is made first (sampler_row.h) */
  CS_SAMPLER_AFFINE,      /* the mean of taps spread over the pixel (sampler_taps.h) */
  CS_SAMPLER_PERSPECTIVE, /* likewise, but how many taps differs from pixel to pixel */
  CS_SAMPLER_SINGLE       /* one by one: bicubic, and means where rows become columns */
} cs_sampler_placement;

typedef enum cs_sampler_kernel {
  CS_SAMPLER_NEAREST,
  CS_SAMPLER_BILINEAR, /* the four texels about the centre */
  CS_SAMPLER_BICUBIC,  /* Catmull-Rom */
  CS_SAMPLER_BOX,      /* the exact mean, of a footprint with sides along those of the picture */
  CS_SAMPLER_TILTED    /* taps over a footprint with any sides */
} cs_sampler_kernel;

typedef struct cs_sampler {
  const cs_picture *picture;
  celspan_matrix
      inverse;           /* frame pixels to picture pixels (texel i covers [i, i+1)), homogeneous */
  int32_t width, height; /* of the picture */
  celspan_sampling sampling;
  celspan_wrap wrap;
  cs_isa isa; /* that its samples are made with */

  /* filled in by cs_sampler_prepare */
  cs_block_cache_source source;
  cs_sampler_placement placement;
  cs_sampler_kernel
      kernel;  /* PERSPECTIVE: CUBIC and TILTED where the picture is enlarged and shrunk */
  double m[9]; /* inverse; where it is affine divided by its last */
  int level_count;
  int level;
  int columns, rows;       /* TILTED: taps across a pixel and down it */
  int32_t opacity_columns; /* to ask cs_sampler_opacity about at a time; INT32_MAX: do not ask */
  bool reads_codes;        /* of blocks that are coded: they are decoded in registers */
  double radius; /* affine: texels of a sample lie at most so far from its centre, picture pixels */
  double wide, high; /* BOX: the sides of the footprint, in picture pixels */
} cs_sampler;

/* Decides how samples are made. */
void cs_sampler_prepare(cs_sampler *sampler);

/* Premultiplied linear RGBA of the pixels of a run. A pixel at or behind the horizon is clear.
 * Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sampler_run(cs_block_cache *blocks, const cs_sampler *sampler,
                                              cs_run run, float (*rgba)[4]);
/* The same of some columns of a row, ascending. */
CELSPAN_CHECKED celspan_status cs_sampler_at(cs_block_cache *blocks, const cs_sampler *sampler,
                                             const int32_t *columns, int32_t count, double y,
                                             float (*rgba)[4]);

/* A picture that is copied: the codes of its texels (cs_picture_block), 4 bytes a pixel. */
CELSPAN_CHECKED celspan_status cs_sampler_codes(cs_block_cache *blocks, const cs_sampler *sampler,
                                                cs_run run, unsigned char *codes);
/* Whether all samples of a run are known to be clear, or opaque; MIXED where it is not known. */
CELSPAN_CHECKED celspan_status cs_sampler_opacity(cs_block_cache *blocks, const cs_sampler *sampler,
                                                  cs_run run, cs_picture_opacity *out);

/* Whether texels are upright and some pixels wide, so that a row of them is worth a span each: of
 * one colour (nearest), or straight from centre to centre. */
bool cs_sampler_is_grid(const cs_sampler *sampler);
/* Of a grid: the columns inside a run at which such spans begin, ascending; at most as many as the
 * limit says. Returns how many. */
size_t cs_sampler_texel_edges(const cs_sampler *sampler, cs_run run, int32_t *columns);
size_t cs_sampler_texel_edge_limit(const cs_sampler *sampler, cs_run run);

#endif
