/* Points with widths as a cubic B-spline with few control points: uniform, clamped or periodic, as
 * strokes are drawn.
 *
 * The control points follow from the least squares of all distances, by conjugate gradients; their
 * number grows until no point is farther away than the tolerance.
 */
#pragma once

#include "inside/context.h"

typedef struct cs_station { /* a place along a line */
  double v[3];              /* x, y, width */
} cs_station;

typedef struct cs_spline {
  cs_station *controls;
  size_t count;
} cs_spline;

/* tolerance: of places; widths may be off by twice as much. out: new, count controls. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_spline_fit(celspan_context *context, const cs_station *stations,
                                             size_t count, bool is_closed, double tolerance,
                                             cs_spline *out);

/* The place at 0..1 on such a spline, from its first point to its last one, or around. A closed
 * spline has at least four points; an open one with fewer than four has a lower degree. */
cs_station cs_spline_at(const celspan_point *points, const double *widths, size_t count,
                        bool is_closed, double parameter);
