/* A line or an arc of a circle along points, by least squares of their distances.
 *
 *         . .-.--. .           f(p) = bend |p|^2 + across . p + offset, p from the origin:
 *       ./         `.          0 on it, and near it the distance from it, below 0 on one side
 *       '           '
 *
 * Sums over points are added to one by one, so that growing sets of points are fitted at little
 * cost. The circle is that of Taubin ("Estimation of planar curves, surfaces, and nonplanar space
 * curves defined by implicit equations", 1991), which stays true for arcs that are short or noisy.
 *
 * INVARIANT: bend is 0 for a line, and half of one divided by the radius for an arc.
 */
#pragma once

#include "celspan/celspan.h"

/* Sums over points, relative to an origin; z is x^2 + y^2. */
typedef struct cs_arc_sums {
  celspan_point origin;
  double count, x, y, xx, xy, yy, xz, yz, zz;
} cs_arc_sums;

typedef struct cs_arc {
  celspan_point origin, across;
  double bend, offset;
} cs_arc;

static inline cs_arc_sums cs_arc_begin(celspan_point origin) {
  return (cs_arc_sums){.origin = origin};
}
void cs_arc_add(cs_arc_sums *sums, celspan_point point);

/* The mean of the squared distances from the best line, and from the best arc. */
double cs_arc_line_error(const cs_arc_sums *sums);
double cs_arc_error(const cs_arc_sums *sums);
/* The best line or arc itself, for two or more different points. */
cs_arc cs_arc_of(const cs_arc_sums *sums, bool is_line);

/* The distance of a point from the arc, and the direction in which the distance grows. */
double cs_arc_off(const cs_arc *arc, celspan_point point, celspan_point *across);
/* The point of the arc that is nearest to a point. */
celspan_point cs_arc_nearest(const cs_arc *arc, celspan_point point);
