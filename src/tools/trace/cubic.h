/* One cubic along points, by least squares.
 *
 *      p0 ---- c0                 c0 = p0 + a * tangent at a joint, free at a corner; c1 likewise
 *              .   .  .  . c1     points lie beside the curve, each at its parameter
 *                        \
 *                         p1
 *
 * Parameters begin as lengths along the points and are brought to the curve's nearest places, a few
 * times over.
 */
#pragma once

#include "tools/trace/edge.h"

/* An end: where the curve is and, where has_tangent, in what direction it leaves towards the other
 * end. */
typedef struct cs_cubic_end {
  celspan_point point, tangent;
  bool has_tangent;
} cs_cubic_end;

/* The state of a point while a cubic is fitted. */
typedef struct cs_cubic_station {
  double parameter;
  double weight, room; /* where gates are passed */
} cs_cubic_station;

/* The points lie between the ends, which are not among them; `stations` is one for each. Returns
 * whether no point is farther away than the tolerance, and all of them, root mean square, not
 * farther than `mean`. */
bool cs_cubic_fit(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                  double tolerance, double mean, cs_cubic_station *stations,
                  celspan_point control[2]);
/* The same for points of whole pixels: returns whether the curve passes all their gates. Gates that
 * are missed most get more weight, round by round (Lawson's algorithm, 1961). */
bool cs_cubic_thread(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                     cs_cubic_station *stations, celspan_point control[2]);
