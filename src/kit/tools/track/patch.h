/* A square of pixels that is found again in another picture (Lucas and Kanade 1981, in the inverse
 * form of Baker and Matthews 2004).
 *
 *      the first picture               another one            the square is turned, scaled and
 *     +-------------------+       +-------------------+       skewed as the motion says; what is
 *     |    +---+          |       |         /\        |       sought is its middle, so that its
 *     |    | + |          |  ->   |        / +\/      |       pixels are most alike, brighter or
 *     |    +---+          |       |        \  /       |       darker, of more or less contrast
 *     |                   |       |         \/        |
 *     +-------------------+       +-------------------+
 */
#pragma once

#include "tools/track/grey.h"

enum {
  CS_PATCH_RADIUS = 9,
  CS_PATCH_SIDE = 2 * CS_PATCH_RADIUS + 1,
  CS_PATCH_COUNT = CS_PATCH_SIDE * CS_PATCH_SIDE
};

/* The place of pixel (u, v) of a patch, counted from the middle of the patch: (x + a u + b v, y + c
 * u + d v). */
typedef struct cs_patch_place {
  double x, y, a, b, c, d;
} cs_patch_place;

typedef struct cs_patch {
  float value[CS_PATCH_COUNT];   /* with a mean of 0 */
  float slope_x[CS_PATCH_COUNT]; /* for each pixel of the patch */
  float slope_y[CS_PATCH_COUNT];
  double inverse[3]; /* xx, xy, yy of the inverse of the sum of slope times slope */
  double deviation;  /* the deviation of the values */
} cs_patch;

/* False if the patch is not wholly in the picture, or has no texture in one direction. */
bool cs_patch_take(const cs_grey *grey, const cs_patch_place *place, cs_patch *out);
/* Moves the middle of `place` to the place where the patch is found. likeness: the correlation
 * there, -1..1. False if it leaves the picture or does not settle. */
bool cs_patch_find(const cs_patch *patch, const cs_grey *grey, cs_patch_place *place,
                   double *likeness);

/* The same over larger distances: tries all whole offsets up to `radius` pixels, and moves the
 * middle by the offset at which the pixels are most similar. likeness: at this offset; -1 if no
 * offset is in the picture. */
void cs_patch_search(const cs_patch *patch, const cs_grey *grey, int radius, cs_patch_place *place,
                     double *likeness);
