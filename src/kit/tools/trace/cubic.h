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

/* An end: the place of the curve and, if has_tangent, its direction towards the other end. */
typedef struct cs_cubic_end {
  celspan_point point, tangent;
  bool has_tangent;
} cs_cubic_end;

/* The state of a point while a cubic is fitted. */
typedef struct cs_cubic_station {
  double parameter;
  double weight, room; /* used if gates must be passed */
} cs_cubic_station;

/* The points lie between the ends, which are not included; there is a station for each. Returns
 * whether no point is farther away than the tolerance, and their root mean square distance is at
 * most `mean`. */
bool cs_cubic_fit(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                  double tolerance, double mean, cs_cubic_station *stations,
                  celspan_point control[2]);
/* The same for points of whole pixels: returns whether the curve passes all their gates. In each
 * round, the gates that are missed most get more weight (Lawson's algorithm, 1961). */
bool cs_cubic_thread(const cs_edge_point *points, size_t count, const cs_cubic_end ends[2],
                     cs_cubic_station *stations, celspan_point control[2]);
