/* Corners of a border, found in the points of its edge.
 *
 *      . . . . . C         where not all points about one lie on an arc they are taken apart into
 *                 .        lines and arcs (stretches.h), of the whole of both sides; where two of
 *       line       .       these, prolonged, intersect at an angle there is a corner
 *                  .
 *            line  .       points next to it, which antialiasing or whole pixels round, say little
 *
 * On a smooth border, however much it bends, one arc continues where the other ends.
 */
#pragma once

#include "tools/trace/edge.h"

/* How points are fitted. */
typedef struct cs_fit_rules {
  double tolerance; /* pixels between a point and the fitted line */
  double mean;      /* the root mean square of these distances */
  double straight;  /* pixels between a point and a line from corner to corner */
  int about;        /* the number of points on either side that determine a tangent */
  double turn;      /* the cosine of the least angle that counts as a corner */
  int near; /* the number of points on either side that lie on an arc if there is no corner */
  double rounding; /* pixels: the distance of points next to a corner from both of its sides */
  double noise;    /* pixels: the distance of points from a smooth border, root mean square */
  bool is_exact;   /* the fitted line passes all gates; tolerance, mean and straight are not used */
} cs_fit_rules;

typedef struct cs_corner {
  size_t at; /* the point that is nearest */
  celspan_point point;
} cs_corner;

typedef struct cs_corner_list {
  cs_corner *items;
  size_t count, capacity;
} cs_corner_list;

/* The corners of points, in order; the points are closed or have ends, which do not count as
 * corners. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_corners_find(celspan_context *context, const cs_points *points,
                                               bool is_closed, const cs_fit_rules *rules,
                                               cs_corner_list *out);
void cs_corners_finish(celspan_context *context, cs_corner_list *corners);
