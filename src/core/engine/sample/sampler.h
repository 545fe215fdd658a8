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
 * CLEAR makes pixels whose centre lies outside the picture clear; inside, texels
 * that a kernel needs beyond an edge equal the edge's texels, so a picture gets no blurred border.
 *
 * The samples of a run depend on the pixel and the maps alone, never on where the run begins, nor
 * on the instructions that make them.
 */
#pragma once

#include "engine/sample/placement.h"
#include "engine/sample/samples.h"
#include "engine/span/run.h"

/* Decides how samples are made. */
void cs_sampler_prepare(cs_sampler *sampler);

/* Premultiplied linear RGBA of the pixels of a run. A pixel at or behind the horizon is clear.
 * Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sampler_run(cs_block_cache *blocks, const cs_sampler *sampler,
                                              cs_run run, float (*rgba)[4]);
/* The same for at most CS_SAMPLER_BATCH pixels, in planes where planes take less time. */
CELSPAN_CHECKED celspan_status cs_sampler_samples(cs_block_cache *blocks, const cs_sampler *sampler,
                                                  cs_run run, cs_samples *out);
/* The same for some columns of a row, ascending. */
CELSPAN_CHECKED celspan_status cs_sampler_at(cs_block_cache *blocks, const cs_sampler *sampler,
                                             const int32_t *columns, int32_t count, double y,
                                             float (*rgba)[4]);

/* Texels of a picture that is copied, which follow one another in a block. */
typedef struct cs_sampler_texels {
  int32_t count;
  int32_t rows;               /* rows of the block, from the row of these texels down */
  cs_picture_opacity opacity; /* the opacity of the block */
  bool are_coded;             /* their codes are exact: cs_picture_block */
  const unsigned char *codes; /* the codes of the first texel; NULL: all texels are clear */
  const float *light;
} cs_sampler_texels;

/* The codes of a picture that is copied, for as many pixels as possible from run.x0 on, at least
 * one. They remain valid until two other blocks are requested (block_cache.h). */
CELSPAN_CHECKED celspan_status cs_sampler_texels_at(cs_block_cache *blocks,
                                                    const cs_sampler *sampler, cs_run run,
                                                    cs_sampler_texels *out);
/* The codes of a run's texels (cs_picture_block), 4 bytes a pixel. */
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
