/* A picture in its place on the frame: the structure from which every file of this room makes
 * samples.
 *
 *      frame                          picture
 *      +---+---+---+   inverse        .  .  .  .  .
 *      |   | o-|---|---------------->   ___
 *      +---+---+---+                  . \  \  .  .    a pixel's centre, and its footprint: the
 *      |   |   |   |                  .  \__\ .  .    parallelogram that its square becomes
 *
 * Invariant: nothing here changes once cs_sampler_prepare has filled it in.
 */
#pragma once

#include "base/wide.h"
#include "model/geometry/matrix.h"
#include "model/pictures/block_cache.h"

/* How the picture lies on the frame, which decides how samples are made. */
typedef enum cs_sampler_placement {
  CS_SAMPLER_COPY,        /* moved by whole pixels, at scale 1: the texels themselves */
  CS_SAMPLER_UPRIGHT,     /* rows stay rows: a line of texels is made first (sampler_row.h) */
  CS_SAMPLER_AFFINE,      /* the mean of taps spread over the pixel (sampler_taps.h) */
  CS_SAMPLER_PERSPECTIVE, /* such a mean; how many taps differs from pixel to pixel */
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
  /* Frame pixels to picture pixels (texel i covers [i, i+1)), homogeneous. */
  celspan_matrix inverse;
  int32_t width, height; /* the width and height of the picture */
  celspan_sampling sampling;
  celspan_wrap wrap;
  cs_isa isa; /* the instructions its samples are made with */

  /* filled in by cs_sampler_prepare */
  cs_block_cache_source source;
  cs_sampler_placement placement;
  /* PERSPECTIVE: BICUBIC where the picture is enlarged, and TILTED where it is shrunk. */
  cs_sampler_kernel kernel;
  double m[9];              /* the inverse; an affine one is divided by its last element */
  int64_t moved_u, moved_v; /* COPY: what is added to a column, and to a row, to find its texel */
  int level_count;
  int level;
  int columns, rows;       /* TILTED: taps across a pixel and down it */
  int32_t opacity_columns; /* most for a call of cs_sampler_opacity; INT32_MAX: not called */
  bool reads_codes;        /* decodes the codes of coded blocks in registers */
  double radius; /* affine: how far the texels of a sample lie from its centre, picture pixels */
  double wide, high; /* BOX: the sides of the footprint, in picture pixels */
} cs_sampler;
