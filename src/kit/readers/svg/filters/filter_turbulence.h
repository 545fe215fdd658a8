/* feTurbulence: Perlin's noise of four channels, as a picture of a texel a unit of the drawing. */
#pragma once

#include "readers/svg/document/reading.h"

/* The noise of an element. */
typedef struct cs_svg_turbulence {
  celspan_box box;       /* the box of the step, in user units */
  celspan_matrix matrix; /* from user units to the drawing's */
  double frequency[2];   /* waves a user unit, 0 or more */
  int octaves;           /* 0 or more */
  int seed;
  bool is_fractal;  /* signed noise, else the sum of absolute values */
  bool is_stitched; /* the noise of the box can be repeated without a seam */
  bool is_coded;    /* the numbers of the result are codes, else light */
} cs_svg_turbulence;

/* *out: new, the box filled with the noise; NULL for a box of no size, or of none that could be
 * seen. Errors: NO_MEMORY; LIMIT for pictures of too many bytes. */
CELSPAN_CHECKED celspan_status cs_svg_turbulence_make(cs_svg_reading *reading,
                                                      const cs_svg_node *node,
                                                      const cs_svg_turbulence *given,
                                                      celspan_object **out);
