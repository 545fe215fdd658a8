/* Alpha without steps. An alpha of 8 bits is rounded to one of 256 steps, and a glow that fades
 * slowly is painted with few of them: it then shows rings where it lies over dark parts.
 *
 *   painted      1.2 1.3 1.4 1.5 1.6 1.7 1.8 ...
 *   stored        1   1   1   2   2   2   2  ...
 *   smooth        the mean of the stored steps around it, held within half a step of its own
 *
 * INVARIANT: a smooth alpha would be rounded to the stored one, or lies half-way; 0 and 1 stay
 * exactly. It is a function of the picture's steps up to CS_SMOOTH_RADIUS pixels away, so it does
 * not depend on the part that is read. Where one of them is between two steps the alpha has more
 * than 8 bits and is left as it is.
 */
#pragma once

#include <celspan/celspan.h>

/* Pixels on each side. Rings up to twice this width plus one are smoothed completely. */
#define CS_SMOOTH_RADIUS 32

/* The alphas of a rectangle and of the area around it, as far as the picture extends. */
typedef struct cs_smooth_alphas {
  int32_t width, height;  /* the width and height of the picture */
  celspan_rectangle area; /* the area of the picture */
  uint32_t *steps;        /* row-major: 0 to 255, or CS_SMOOTH_BETWEEN */
  uint32_t *sums;         /* scratch memory, as many as the area has columns */
} cs_smooth_alphas;

/* More than the sum of all steps in one mean. */
#define CS_SMOOTH_BETWEEN ((uint32_t)1 << 21)

/* The alphas that are needed to smooth a rectangle of a picture, without their memory. */
cs_smooth_alphas cs_smooth_around(const celspan_rectangle *rectangle, int32_t width,
                                  int32_t height);
/* Sets `count` steps of row y of the picture, from column x on, from premultiplied RGBA. */
void cs_smooth_set(const cs_smooth_alphas *alphas, int32_t x, int32_t y, const float *rgba,
                   int32_t count);
/* Makes the alpha of a rectangle smooth, and its premultiplied colour with it: row-major RGBA. All
 * steps of the area are set. */
void cs_smooth_rectangle(const cs_smooth_alphas *alphas, const celspan_rectangle *rectangle,
                         float *rgba);
