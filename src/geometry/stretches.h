/* Stretches: what falls or rises along one contour, in the order of the contour, until they are
 * joined to chains.
 *
 *        .0.            the contour begins at 0 and goes down the left side
 *      1'   '5
 *      |     |          stretches 1 2 3: direction +1, one chain from top to bottom
 *      2     4                    4 5 0: direction -1, another; it runs over the beginning of the
 *       '.3.'                            contour, and its pieces are put in the reverse order
 *
 * Invariant: the piece of a stretch runs downwards, whatever its direction is.
 */
#ifndef CS_GEOMETRY_STRETCHES_H
#define CS_GEOMETRY_STRETCHES_H

#include "geometry/boundary.h"

typedef struct cs_stretch {
  cs_boundary_piece piece;
  int32_t direction; /* along the contour: +1 down, -1 up */
} cs_stretch;

typedef struct cs_stretches {
  cs_stretch *items;
  size_t count, capacity;
} cs_stretches;

/* Reverses the order of those from `begin` on. turns_direction: they then go the other way too. */
void cs_stretches_reverse(cs_stretches *stretches, size_t begin, bool turns_direction);

/* Appends the chains of a closed contour to the set. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stretches_join(celspan_context *context,
                                                 const cs_stretches *stretches, uint32_t layer,
                                                 cs_boundary_set *set);

#endif
