/* A walk down a chain of boundaries, segment by segment from its top to its bottom. The segments
 * are made as the walk comes to them, a group at a time (polyline.h), so that a long curve of which
 * few rows are wanted is never flattened as a whole.
 *
 *      (x0, y0) *            the current segment: x(y) = x0 + d (slope + d curve), d = y - y0
 *                \           with curve 0 a chord, else an arc
 *       y --------+-- x
 *                  \
 *          (x1, y1) *        cs_boundary_next goes to the segment below: of the same group, else of
 *                  /         the next group of the piece, else of the next piece of the chain
 *
 * Invariant: the segment at a height, and so x there, does not depend on where the walk began.
 */
#pragma once

#include "model/geometry/boundary.h"

typedef struct cs_boundary_walk {
  double x0, y0, x1, y1;
  double slope, curve; /* as in cs_boundary_group */
  uint32_t chain;
  uint32_t piece;   /* index into pieces */
  uint32_t group;   /* the number in the piece of the first group in `made` */
  uint32_t segment; /* the number of the segment in `made` */
  cs_boundary_group made;
} cs_boundary_walk;

/* Begins at the first segment whose y1 is below y (greater); y must be above the chain's y1. */
void cs_boundary_start(const cs_boundary_set *set, uint32_t chain, double y,
                       cs_boundary_walk *walk);
/* Advances to the next segment; at the end of the chain returns false and changes nothing. */
bool cs_boundary_next(const cs_boundary_set *set, cs_boundary_walk *walk);

/* x at a height on the walk's segment. */
static inline double cs_boundary_x(const cs_boundary_walk *walk, double y) {
  double down = y - walk->y0;
  return walk->x0 + down * (walk->slope + down * walk->curve);
}
