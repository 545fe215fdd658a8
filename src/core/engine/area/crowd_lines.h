/* Areas right of lines in a pixel of a crowd, doubled.
 *
 *      +----.-------+
 *      |     `. ####|     ###: right of both lines. Between two heights at which neither begins
 *      |    /  `.###|     nor ends that is what lies right of the greater x, and twice that area
 *      |   /    /`.#|     is the height times the sum of both widths; less a triangle where they
 *      +--/----/---`+     cross.
 *
 * Invariant: where lines do not cross or begin in each other's heights all numbers here are whole,
 * so sums of them are exact; and a line against itself gives the area right of it.
 */
#pragma once

#include <math.h>
#include <stdint.h>

#define CS_CROWD_UNIT 4096
#define CS_CROWD_TWICE (2.0 * CS_CROWD_UNIT * CS_CROWD_UNIT) /* twice the area of a pixel */

typedef struct cs_crowd_line {
  int32_t xa, ya, xb, yb; /* units; ya < yb */
  int32_t direction;      /* by how much the sum grows right of the line */
} cs_crowd_line;

/* x of a line at two heights. */
typedef struct cs_crowd_ends {
  double top, foot;
} cs_crowd_ends;

/* The heights lie between the ends of the line. */
static inline cs_crowd_ends cs_crowd_ends_of(const cs_crowd_line *line, double top, double foot) {
  if (line->xa == line->xb || (line->ya == top && line->yb == foot))
    return (cs_crowd_ends){line->xa, line->xb};
  double slope = (double)(line->xb - line->xa) / (line->yb - line->ya);
  return (cs_crowd_ends){line->xa + slope * (top - line->ya), line->xa + slope * (foot - line->ya)};
}

static inline double cs_crowd_right_of_one(const cs_crowd_line *line) {
  return (double)(line->yb - line->ya) * (2 * CS_CROWD_UNIT - line->xa - line->xb);
}

static inline double cs_crowd_right_of_two(const cs_crowd_line *a, const cs_crowd_line *b) {
  int32_t top = a->ya > b->ya ? a->ya : b->ya, foot = a->yb < b->yb ? a->yb : b->yb;
  if (top >= foot)
    return 0;
  cs_crowd_ends p = cs_crowd_ends_of(a, top, foot), q = cs_crowd_ends_of(b, top, foot);
  double above = p.top - q.top, below = p.foot - q.foot, height = foot - top;
  double right = 2 * CS_CROWD_UNIT - (above > 0 ? p.top : q.top) - (below > 0 ? p.foot : q.foot);
  if (above * below < 0)
    right -= above * below / (fabs(above) + fabs(below));
  return right * height;
}
