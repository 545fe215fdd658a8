/* Vertices of polylines, and where they lie beside the curve.
 *
 *         o k-1         For a chord of length h the area between chord and curve is
 *        / .            |C' x C''| h^3 / 12. Each end of the chord is displaced along -C'' so
 *       /   .           far that it makes up for half of the area: its share.
 *  k   o     .  curve
 *       \   .           The ends of a piece cannot be displaced. The chords there are shorter, by a
 *        \ .            square root of 2, so that what their other ends are displaced by makes up
 *         o k+1         for all of the area.
 *
 * A border of two groups is displaced only where the curve is bent too much for an arc: then by the
 * displacement for even steps, so that both groups know it. Else it lies on the curve, because an
 * arc may end there, and its neighbours are displaced by more, like the neighbours of any vertex
 * that is not displaced by its own share.
 *
 * The seat of a vertex is the parameter of the curve at which it is made. Vertices have even steps
 * of the parameter between them, except at the ends of a piece, and a vertex within a sixth of a
 * step from a whole height gets the parameter of that height.
 */
#pragma once

#include "base/number.h"
#include "model/geometry/boundary.h"

/* No vertex is displaced outwards by more sags than this; the sag of a chord is C'' h^2 / 8. Moving
 * a vertex along the curve to a whole height displaces it further: by at most about a quarter of a
 * step, and half a pixel in y. The shares of a vertex are then at most 0.29 h^2. */
#define CS_POLYLINE_LIFT 2.4

/* How much shorter than a step the first and the last chord of a piece are, in steps: 1 - 1 /
 * sqrt(2). */
#define CS_POLYLINE_LEAD 0.29289321881345254

/* The step of the parameter from vertex to vertex of a piece of two chords or more. */
static inline double cs_polyline_step(uint32_t chords) {
  return 1 / (chords - 2 * CS_POLYLINE_LEAD);
}

/* The parameter of a vertex before it is moved. */
static inline double cs_polyline_parameter(const cs_boundary_piece *piece, uint32_t vertex) {
  double t = (vertex - CS_POLYLINE_LEAD) * piece->step;
  return t > 0 ? t < 1 ? t : 1 : 0;
}
