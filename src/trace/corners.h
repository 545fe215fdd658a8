/* Corners of a border, found in the points of its edge.
 *
 *      . . . . . C         before a corner and after it the border is fitted by a parabola each,
 *                 .        through points near it but for the very nearest, which antialiasing
 *      parabola    .       rounds; where both, prolonged, come in at different angles there is a
 *      from here .. .      corner, where they intersect
 *
 * On a smooth border, however much it bends, both come in at the same angle. Where the next corner is
 * near, the parabola does not get past it: it is through fewer points, until it is near all of them.
 * A bend that the few points about it have a parabola through is none, however narrow it is. Of the
 * points about a corner that one is taken from which both are nearest to theirs.
 */
#ifndef CS_TRACE_CORNERS_H
#define CS_TRACE_CORNERS_H

#include "trace/edge.h"

/* How points are fitted. */
typedef struct cs_fit_rules {
  double tolerance; /* pixels between a point and what is fitted */
  int about;        /* points on either side that give a tangent */
  double turn;      /* cosine of the least angle that is a corner */
  int evening;      /* times that points are made even with their neighbours */
  int near;         /* points on either side that a smooth border has a parabola through */
  double smooth;    /* pixels, root mean square, that they are off it */
  double noise;     /* pixels, root mean square, that points are off a smooth border */
} cs_fit_rules;

typedef struct cs_corner {
  size_t at; /* the point that is nearest */
  celspan_point point;
} cs_corner;

typedef struct cs_corner_list {
  cs_corner *items;
  size_t count, capacity;
} cs_corner_list;

/* The corners of points, closed or with ends, which are none; in their order. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_corners_find(celspan_context *context, const cs_points *points,
                                               bool is_closed, const cs_fit_rules *rules,
                                               cs_corner_list *out);

/* Points that are fitted: those at origin + step * (skipped .. skipped + count - 1), step being 1 or
 * -1; around the end where they are closed. */
typedef struct cs_stretch_of_points {
  const cs_points *points;
  ptrdiff_t origin;
  int step, skipped, count; /* two points at least */
} cs_stretch_of_points;

/* The parabola through them by least squares, over their lengths along the border, where it is at the
 * origin. */
typedef struct cs_parabola {
  celspan_point point, tangent; /* the latter along the steps, of length 1; 0 0: none */
  double error;                 /* the mean of the squares of distances */
} cs_parabola;
cs_parabola cs_parabola_at(const cs_stretch_of_points *stretch);

#endif
