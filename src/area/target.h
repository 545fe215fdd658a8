/* Where the edge segments of a row go: to the window, which makes the row's pixels, or into a row
 * of retained edges, for filters that extend over several rows.
 *
 *   lone boundaries --+                    +--> cs_window         pixels and spans of this row
 *                     +--> segments: target
 *   local sweeps   ---+                    +--> cs_retained_row   kept for kernel/, no pixels
 *
 * Invariant: items (lone boundaries and local sweeps) come from left to right; `retained` does not
 * change between the beginning and the end of a row.
 */
#ifndef CS_AREA_TARGET_H
#define CS_AREA_TARGET_H

#include "area/window.h"
#include "kernel/retained.h"

typedef struct cs_target {
  cs_window window;
  cs_retained_row *retained; /* borrowed; NULL: the window has the segments */
} cs_target;

/* An item begins whose least x is `x`. */
static inline CELSPAN_CHECKED celspan_status cs_target_begin_item(cs_target *target, double x) {
  return target->retained ? CELSPAN_OK : cs_window_begin_item(&target->window, x);
}

/* A segment of the current item between two cells. */
static inline CELSPAN_CHECKED celspan_status cs_target_add(cs_target *target,
                                                           const cs_segment *segment,
                                                           const cs_cell *left,
                                                           const cs_cell *right) {
  return target->retained
             ? cs_retained_add(target->retained, target->window.composer, segment, left, right)
             : cs_window_add(&target->window, segment, left, right);
}

#endif
