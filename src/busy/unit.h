/* Units: the way of one chain through one row.
 *
 *      y      +-------+--*----+-------+   *: points, from the top down; between them it is straight
 *             |       |   \   |       |
 *             |       |    *. |       |   low, high: the least and the greatest x
 *             |       |      `*.      |
 *      y + 1  +-------+-------+-`*----+   here it crosses the columns first..last
 *
 * Heights in a unit are counted from the top of its row, 0..1, and are multiples of 2^-28
 * (area/edges.h), so that sums of areas are exact.
 *
 * Invariant: chains with the same points in either direction make units with the same points.
 */
#ifndef CS_BUSY_UNIT_H
#define CS_BUSY_UNIT_H

#include "base/context.h"
#include "celspan/celspan.h"

typedef struct cs_unit {
  double low, high;
  double y0, y1;  /* 0 <= y0 < y1 <= 1 */
  double left;    /* the area between x = 0 and the unit */
  uint32_t point; /* the first of its points */
  uint32_t count; /* of points: at least 2 */
  uint32_t layer;
  int32_t direction;   /* of its chain, as it is crossed from left to right */
  int32_t first, last; /* the columns it crosses; last < first: it lies beside the frame */
  uint32_t node;       /* of its first column: columns.h */
} cs_unit;

/* All units of a row. */
typedef struct cs_units {
  cs_unit *units;
  celspan_point *points;
  size_t count, point_count;
  size_t capacity, point_capacity;
} cs_units;

static inline const celspan_point *cs_units_points(const cs_units *units, const cs_unit *unit) {
  return units->points + unit->point;
}

#endif
