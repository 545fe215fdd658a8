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
#ifndef CS_TRACE_CUBIC_H
#define CS_TRACE_CUBIC_H

#include "celspan/celspan.h"

/* An end: where the curve is and, where has_tangent, in what direction it leaves towards the other
 * end. */
typedef struct cs_cubic_end {
  celspan_point point, tangent;
  bool has_tangent;
} cs_cubic_end;

/* `parameters` is room for count numbers; the points lie between the ends, which are not among them.
 * Returns whether no point is farther away than the tolerance, and all of them, root mean square, not
 * farther than `mean`. */
bool cs_cubic_fit(const celspan_point *points, size_t count, const cs_cubic_end ends[2],
                  double tolerance, double mean, double *parameters, celspan_point control[2]);

#endif
