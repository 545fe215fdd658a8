/* Paints as affine maps on light, the Beta colour model premultiplied.
 *
 *      rear                 front
 *               +-------+
 *     I  ------>|   T --+---->   S F + T I      S = beta * pigment
 *               |   S --+---->                  T = (1 - beta) * medium
 *               +-------+<----  F
 *
 * F is the light that falls on the front, I the light from behind; their sum leaves to the front.
 * Invariant: 0 <= S <= beta and 0 <= T <= 1 - beta; only pictures may have a greater S. A paint is
 * opaque if T = 0, whatever beta is.
 */
#pragma once

#include "celspan/celspan.h"

typedef struct cs_paint {
  float s[3], t[3];
  float beta;
} cs_paint;

#define CS_PAINT_CLEAR ((cs_paint){{0, 0, 0}, {1, 1, 1}, 0})

/* Composition stops when every channel of T is at most this. */
#define CS_PAINT_OPAQUE 0x1p-16f

cs_paint cs_paint_from_straight(const celspan_paint *paint);
/* The paint of one sample of a picture. rgba: premultiplied, linear. */
cs_paint cs_paint_from_picture(const float rgba[4], celspan_picture_use use);
/* weight * paint + (1 - weight) * clear. */
cs_paint cs_paint_fade(cs_paint paint, float weight);
/* (1 - u) * p + u * q. */
cs_paint cs_paint_mix(const cs_paint *p, const cs_paint *q, float u);
/* Whether all seven straight values are in 0..1. */
bool cs_paint_is_valid(const celspan_paint *paint);

static inline bool cs_paint_is_opaque(const cs_paint *paint) {
  return paint->t[0] <= CS_PAINT_OPAQUE && paint->t[1] <= CS_PAINT_OPAQUE &&
         paint->t[2] <= CS_PAINT_OPAQUE;
}
