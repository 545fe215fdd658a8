/* Sides: what lies right of a unit in a pixel, or below an event, and how sides overlap.
 *
 *     top   +--\----------/--+      In a slab every side that is there goes from top to foot. Its
 *           | a \     b /    |      area is what lies right of its unit; the area right of several
 *           |    \    /      |      is what lies right of the rightmost of them at each height:
 *    foot   +-----\--/-------+      here right of b.
 *
 * Invariant: areas are multiples of 2^-28 and depend on the points of the units alone.
 */
#ifndef CS_BUSY_SIDE_H
#define CS_BUSY_SIDE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "celspan/celspan.h"

#define CS_SIDE_TANGLE 4 /* sides whose overlaps are measured together, at most */

/* What lies right of a unit at its heights, or below an event. */
typedef struct cs_side {
  const celspan_point *points; /* of a unit; NULL: an event */
  uint32_t count;
  uint32_t layer;
  int32_t change;   /* of its winding, from outside to inside */
  double y0, y1;    /* its heights */
  double low, high; /* of a unit: the least and the greatest x */
  double area;      /* 0..y1 - y0 */
} cs_side;

/* A side in a slab, and the area right of it there. */
typedef struct cs_present {
  const cs_side *side;
  double right;
  size_t first; /* the number of the leftmost side of its tangle */
} cs_present;

/* A part of the pixel's height through which all units go that are in it. */
typedef struct cs_slab {
  double top, foot;
} cs_slab;

/* The area of a side in a slab of the pixel of a column. */
double cs_side_area(int32_t column, const cs_side *side, const cs_slab *in);
/* Whether one side is nowhere right of another one in a slab, as far as the pixel shows. */
bool cs_side_is_left(const cs_present *a, const cs_present *b, const cs_slab *in);
/* The height inside a slab at which two units cross first; the foot of the slab: there is none. */
double cs_side_intersection(const cs_present *a, const cs_present *b, const cs_slab *in);
/* In order from left to right: by area, then by anything that tells apart what is not the same. */
bool cs_side_is_before(const cs_present *a, const cs_present *b);
/* The area right of all units of a set, one bit a member, in a slab. They are units, at most
 * CS_SIDE_TANGLE. */
double cs_side_area_right(int32_t column, const cs_present *tangle, unsigned set,
                          const cs_slab *in);

#endif
