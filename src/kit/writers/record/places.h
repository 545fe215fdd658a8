/* Converts planes over pixels of the plan to planes over the frame of a plane file.
 *
 * Invariant: a plane over the frame has the value at (x, y), 0 to 1 in both directions, that the
 * plane over pixels has at the same place.
 */
#pragma once

#include "inside/geometry.h"
#include "writers/record/recording.h"

static inline void cs_place_plane(const double over_pixels[3], double out[3]) {
  out[0] = over_pixels[0] * CS_RECORD_SIDE;
  out[1] = over_pixels[1] * CS_RECORD_SIDE;
  out[2] = over_pixels[2];
}

/* Whether a matrix from pixels of the plan has no perspective; if so, its w counts as 1. */
static inline bool cs_place_is_affine(const celspan_matrix *inverse) {
  return inverse->m[6] == 0 && inverse->m[7] == 0 && inverse->m[8] > 0;
}

/* The function of[0] u + of[1] v + of[2] w of own units. inverse: from pixels of the plan to own
 * units. */
static inline void cs_place_own(const celspan_matrix *inverse, const double of[3], double out[3]) {
  const double *m = inverse->m;
  double over_pixels[3], last = cs_place_is_affine(inverse) ? m[8] : 1;
  for (int k = 0; k < 3; k++)
    over_pixels[k] = (of[0] * m[k] + of[1] * m[3 + k] + of[2] * m[6 + k]) / last;
  cs_place_plane(over_pixels, out);
}
