/* Borders: what rows are made of between heights. A border is a straight piece of a boundary,
 * and the cells on its sides.
 *
 *         left  \  right      window.h sums it into the pixels of its row, retained.h keeps it for
 *                \            filters that extend from row to row, and swept.h makes it a part of a
 *                 \           map
 *
 * Invariant: at any height of a row, the borders that cross it lead from the leftmost cell to the
 * rightmost one, each beginning with the colours right of the border before it. So the colour at a
 * point is that of the leftmost cell plus the steps of all borders left of the point, in whatever
 * order they are added.
 */
#pragma once

#include "engine/compose/cell.h"
#include "model/geometry/segment.h"

typedef struct cs_border {
  cs_segment line;
  const cs_cell *left, *right; /* borrowed from whoever made the border, for as long as its row */
} cs_border;
