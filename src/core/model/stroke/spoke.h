/* Spokes: from a place of the line to the side of the stroke that is on the right of its way.
 *
 *   o tip                     The disc of the place touches the envelope of all discs at the tip.
 *    \ direction              slope = dr/ds: how fast the radius grows along the way.
 *     \                          direction = -slope * tangent + sqrt(1 - slope^2) * right
 * -----*-----> tangent        The envelope continues at a right angle to the spoke. If a disc is
 *    centre                   inside its neighbour, the slope is beyond +-1, and is clamped to +-1.
 */
#pragma once

#include <math.h>

#include "model/stroke/curve.h"

typedef struct cs_spoke {
  celspan_point centre, tangent, direction, tip;
  double radius, slope; /* slope: -1 .. 1 */
} cs_spoke;

/* How a spoke moves when its place moves along the curve.
 *
 *           *---> a place that moves          It turns about its pivot, the point of its line that
 *          /                                  goes along the line itself. Beyond a pivot on its own
 *         o pivot                             side of the curve it goes backwards.
 *        /
 *   <---* tip
 */
typedef struct cs_spoke_motion {
  /* 1: the tip goes forwards, in the order of a contour; -1: backwards; 0: it does not move */
  int pace;
  /* the distance from the centre, 0 .. radius, if the pace is -1 or 0; otherwise no meaning */
  double pivot;
  double drift; /* how fast the place moves along the spoke, by the parameter */
} cs_spoke_motion;

static inline celspan_point cs_spoke_add(celspan_point p, double k, celspan_point v) {
  return (celspan_point){p.x + k * v.x, p.y + k * v.y};
}
static inline celspan_point cs_spoke_away(celspan_point from, celspan_point to) {
  return (celspan_point){to.x - from.x, to.y - from.y};
}
static inline double cs_spoke_dot(celspan_point a, celspan_point b) {
  return a.x * b.x + a.y * b.y;
}
static inline double cs_spoke_cross(celspan_point a, celspan_point b) {
  return a.x * b.y - a.y * b.x;
}
/* The directions on the right and on the left of a direction: a quarter turn against the order of a
 * contour, and one in that order. */
static inline celspan_point cs_spoke_right(celspan_point v) { return (celspan_point){v.y, -v.x}; }
static inline celspan_point cs_spoke_left(celspan_point v) { return (celspan_point){-v.y, v.x}; }
static inline celspan_point cs_spoke_back(celspan_point v) { return (celspan_point){-v.x, -v.y}; }

cs_spoke cs_spoke_make(celspan_point centre, double radius, celspan_point tangent, double slope);
/* The spoke of a curve at a parameter. */
cs_spoke cs_spoke_at(const cs_curve *curve, double t);
cs_spoke_motion cs_spoke_move(const cs_curve *curve, double t, const cs_spoke *spoke);
/* The same place seen in the opposite direction: the spoke to the other side. */
cs_spoke cs_spoke_turned(const cs_spoke *spoke);
/* The angle from the tangent to the spoke, 0 .. pi, and the angle from one direction to another
 * direction, -pi .. pi, > 0 with the order of a contour. */
double cs_spoke_lean(const cs_spoke *spoke);
double cs_spoke_angle(celspan_point from, celspan_point to);
