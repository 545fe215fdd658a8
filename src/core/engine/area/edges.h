/* The edges of a row: where every active boundary lies in it, and the area right of it in the
 * pixels that it crosses, for all boundaries at once and several at a time.
 *
 *           low            high
 *            |               |
 *      +-----.-+-------+-------+-----
 *      |     `.|#######|#######|##         ###: right of the edge
 *      |       |`-.####|#######|##         one: the share of the first column
 *      |       |   `-.#|#######|##         two: the share of the last column
 *      |       |      `|-.#####|##         fall: by how much the share grows from each column
 *      |       |       |  `-.##|##               between them to the next
 *      +-------+-------+-----`-+----
 *      first   second  last
 *
 * Invariants: the values are the same whichever instructions compute them. Areas are multiples of
 * 2^-28 (cover.h) of a whole row's height. They are given where the boundary crosses at most two
 * columns, or is straight and stays in the frame; where it leaves the frame sideways, `end` is at
 * least first + 3, or first if it does not enter the frame.
 */
#pragma once

#include "base/wide.h"
#include "engine/sweep/active.h"
#include "model/geometry/cover.h"

typedef struct cs_edges {
  cs_isa isa;         /* the instructions that straight boundaries are measured with */
  double *low, *high; /* the least and the greatest x in the row */
  /* the shares of the boundary's first and last column that lie right of the boundary */
  float *one, *two;
  /* for more than two columns: the area in the second column, and how much the area grows from
   * each column to the next; 0 where there are no areas */
  float *second, *fall;
  /* the columns that the boundary crosses; empty if it lies on a pixel's edge */
  int32_t *first, *end;
  bool *is_bent;                    /* the boundary has vertices in the row */
  CS_ARRAY(unsigned char, storage); /* one allocation for all the arrays above */
  size_t capacity;                  /* the capacity of each array */
} cs_edges;

void cs_edges_finish(cs_edges *edges, cs_memory *memory);
/* Measures the boundaries between the current height and the height advanced to. width: of the row.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_edges_measure(celspan_context *context, cs_edges *edges,
                                                const cs_active *active, int32_t width);

/* ---- edges_wide.c: the boundaries as if all were straight */

CS_WIDE_DECLARE(void, cs_edges_straight,
                (cs_edges * edges, const double *top, const double *foot, size_t count,
                 int32_t width));

/* The column of the frame at or left of x (floor), or at or right of it (ceil), clamped to the row;
 * 0 where x is not a number. */
static inline int32_t cs_edges_floor(double x, int32_t width) {
  return !(x > 0) ? 0 : x >= width ? width : (int32_t)x;
}

static inline int32_t cs_edges_ceil(double x, int32_t width) {
  int32_t column = cs_edges_floor(x, width);
  return column + (column < x && column < width);
}
