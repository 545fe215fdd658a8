/* A filter kernel as rows use it: its antiderivatives, tabulated, or an even shape.
 *
 *       share of the kernel                    an edge at x cuts the kernel of a pixel: what lies
 *       1 |            ____                    right of the edge is weighted by the share right of
 *         |          /                         it, read from the table
 *      .5 |       /
 *         |    /                                         |<-radius->|
 *       0 |__/_____________ x                  (          *    |     )   kernel of the pixel at *
 *           -1    0    1   times the radius                   edge
 *
 * In units of its radius, u in -1..1, a separable kernel is a step function over equal parts. Its
 * integral is then piecewise linear, so a filtered edge has neither gap nor overlap: the weights
 * that the integral gives to the parts of a whole sum to 1. An even shape (a disc, a turned box) is
 * cut at a height into one interval, in which the kernel is constant.
 */
#pragma once

#include "base/arrays.h"
#include "model/scene/antialias.h"

/* The blur of a defocused cel, in the samples of a grid. */
typedef struct cs_blur {
  celspan_defocus_kernel kind;
  double radius_x, radius_y; /* GAUSSIAN: two sigmas, and it extends twice as far; DISC */
  double edges[2][2];        /* BOX: half of two sides, as vectors */
  double blur;               /* width of the square that is also averaged over; 0: none */
  double steps[2];           /* PIXEL: from sample to sample, where that is above 1 */
} cs_blur;

/* BOX: whether its sides lie along the axes. */
bool cs_blur_is_upright(const cs_blur *blur);

typedef enum cs_kernel_shape {
  CS_KERNEL_SEPARABLE,
  CS_KERNEL_ELLIPSE,      /* constant inside an ellipse with these radii */
  CS_KERNEL_PARALLELOGRAM /* even inside */
} cs_kernel_shape;

typedef struct cs_kernel {
  cs_kernel_shape shape;
  double radius_x, radius_y; /* pixels: how far it reaches */
  double per_radius_y;       /* 1 / radius_y */
  int rows;                  /* segments that a slanted edge is cut into, for each row */
  bool is_signed;            /* negative somewhere */
  double sharpness;          /* SEPARABLE: how finely a slanted edge is cut; 1 for the sharpest */
  double edges[2][2];        /* PARALLELOGRAM: half of two sides; the second is the steeper */
  int offsets;   /* even shapes: the kernel is the mean of offsets x offsets copies of the shape */
  double spread; /* the width of the square over which copies are spread evenly */
  /* At -1 + 2 i / SAMPLES in units of the radius: shares of the kernel, 0 .. 1 */
  double above[CS_ANTIALIAS_SAMPLES + 1]; /* the share of the kernel over a height */
  /* SEPARABLE: the shares to the right of an edge that lies phase/phases right of a pixel's centre.
   * They begin `columns` columns left of that pixel; there are `stride` of them, after which they
   * are 1. */
  CS_ARRAY(float, shares);
  int phases;
  int32_t columns, stride;
} cs_kernel;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_kernel_create(celspan_context *context,
                                                const cs_antialias *antialias, cs_kernel **out);
/* The kernel of a defocused cel, as separable or even shape. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_kernel_create_defocus(celspan_context *context,
                                                        const cs_blur *blur, cs_kernel **out);
void cs_kernel_free(cs_kernel *kernel, cs_memory *memory);
/* The chord of an even shape at height d from its centre: from *from to *to; false outside of the
 * shape. */
bool cs_kernel_chord(const cs_kernel *kernel, double d, double *from, double *to);
/* Rows and columns that a kernel may extend beyond its pixel. */
int32_t cs_kernel_extent(const cs_kernel *kernel);

/* The value of a table at u, in units of the radius. */
static inline double cs_kernel_interpolate(const double *table, double u) {
  double at = (u + 1) * (CS_ANTIALIAS_SAMPLES / 2);
  if (!(at > 0))
    return 0;
  if (at >= CS_ANTIALIAS_SAMPLES)
    return 1;
  int i = (int)at;
  return table[i] + (at - i) * (table[i + 1] - table[i]);
}

/* The share of the kernel above the height d below its centre. */
static inline double cs_kernel_above(const cs_kernel *kernel, double d) {
  return cs_kernel_interpolate(kernel->above, d * kernel->per_radius_y);
}
