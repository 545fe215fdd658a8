/* Bends: what happens to the boundaries that are not a single segment between two heights.
 *
 * From one row to the next every boundary advances from the current height y to the height y_next.
 * A boundary is a polyline of segments; where a segment ends between the two heights the boundary
 * has a vertex there, and the row notes a bend:
 *
 *        x[0]     x[1]         x[2]     x[3]
 *   -----*--------*------------*--------*-------------------- y       current height
 *        |         \           |         \
 *        |          o vertex   |          \
 *        |         /           o end       \
 *        |        /                         \
 *   -----*-------*---------------------------*--------------- y_next  height advanced to
 *    x_next[0] x_next[1]                  x_next[3]
 *
 *   boundaries 0 and 3: no bend; 1: a bend with one vertex; 2: a bend that ends, at x_next[2]
 */
#ifndef CS_SWEEP_BEND_H
#define CS_SWEEP_BEND_H

#include <stdbool.h>
#include <stdint.h>

/* One boundary between the heights, when it is not a single segment there. */
typedef struct cs_bend {
  uint32_t boundary;     /* its index in the order at the current height */
  uint32_t vertex;       /* the first of its vertices strictly between the heights, downwards */
  uint32_t vertex_count; /* the number of them */
  bool ends;             /* its chain does not cross the next height */
  bool ends_above;       /* its chain ends above the next height, at its last vertex */
  double low, high;      /* the least and the greatest x on the way, both ends included */
} cs_bend;

#endif
