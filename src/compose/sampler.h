/* Pictures along a row: inverse mapping of pixel centres to texels, filtered.
 *
 * A pixel gets one sample at its centre: the texel itself at whole-pixel placement and scale 1 (bit
 * exact), interpolation when enlarged (Catmull-Rom for bicubic), the average in linear light over
 * the pixel's footprint when shrunk: exact up to a factor of 8 while rows stay rows or columns,
 * from mip levels beyond, and by up to 16 taps an axis where the footprint is tilted. The footprint
 * is that of the pixel's parallelogram under the inverse map, so rotation, unequal scaling and
 * perspective are right too. Nearest is the texel under the centre, at any scale.
 *
 * CLEAR makes pixels whose centre lies outside the picture clear; inside, what a kernel wants
 * beyond the edge is the edge's, so a picture gets no soft border of its own.
 *
 * The samples of a run depend on the pixel and the maps alone, never on where the run begins.
 */
#ifndef CS_COMPOSE_SAMPLER_H
#define CS_COMPOSE_SAMPLER_H

#include "geometry/matrix.h"
#include "scene/picture.h"

typedef struct cs_sampler {
  const cs_picture *picture;
  celspan_matrix
      inverse;           /* frame pixels to picture pixels (texel i covers [i, i+1)), homogeneous */
  int32_t width, height; /* of the picture */
  celspan_sampling sampling;
  celspan_wrap wrap;
} cs_sampler;

/* Premultiplied linear RGBA of the pixels x0 .. x0+count-1 on the row whose centre is at height y
 * (pixels). A pixel at or behind the horizon is clear. Threads: any, each with its own branch of
 * the context. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sampler_run(celspan_context *context, const cs_sampler *sampler,
                                              int32_t x0, int32_t count, double y,
                                              float (*rgba)[4]);

#endif
