#include "model/geometry/boundary_walk.h"

#include <math.h>

#include "model/geometry/polyline.h"

/* Copies the fields of segment walk->segment of the group that has been made. */
static inline void copy_segment(cs_boundary_walk *walk) {
  const cs_boundary_group *made = &walk->made;
  uint32_t at = walk->segment;
  walk->x0 = made->x[at];
  walk->y0 = made->y[at];
  walk->x1 = made->x[at + 1];
  walk->y1 = made->y[at + 1];
  walk->slope = made->slope[at];
  walk->curve = made->curve[at];
}

/* leaps: false for a group in the middle of a leap whose arc was rejected. */
static void begin_group(const cs_boundary_set *set, cs_boundary_walk *walk, uint32_t group,
                        bool leaps) {
  cs_polyline_group(set, &set->pieces[walk->piece], group, leaps, &walk->made);
  walk->group = walk->made.first;
  walk->segment = 0;
}

bool cs_boundary_next(const cs_boundary_set *set, cs_boundary_walk *walk) {
  const cs_boundary_chain *chain = &set->chains[walk->chain];
  const cs_boundary_piece *piece = &set->pieces[walk->piece];
  if (walk->segment + 1 < walk->made.count) {
    walk->segment++;
  } else if ((walk->group + walk->made.groups) * piece->group < piece->chords) {
    uint32_t group = walk->group + walk->made.groups;
    begin_group(set, walk, group, group % piece->leap == 0);
  } else if (walk->piece + 1 < chain->piece + chain->piece_count) {
    walk->piece++;
    begin_group(set, walk, 0, true);
  } else {
    return false;
  }
  copy_segment(walk);
  return true;
}

/* The first piece of the chain that ends below y. */
static uint32_t find_piece(const cs_boundary_set *set, const cs_boundary_chain *chain, double y) {
  uint32_t low = chain->piece, high = chain->piece + chain->piece_count - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (set->pieces[middle].y1 > y)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* A group that is not after the first group of the piece that ends below y. There is a margin of
 * half a pixel, because the end of a group may have been moved to a whole height. */
static uint32_t find_group(const cs_boundary_set *set, const cs_boundary_piece *piece, double y) {
  double rounding = 1e-10 * (1 + fabs(piece->y0) + fabs(piece->y1)), safe = y - 0.5 - rounding;
  uint32_t low = 0, high = piece->chords / piece->group - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (cs_polyline_plain(set, piece, (middle + 1) * piece->group).y > safe)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

void cs_boundary_start(const cs_boundary_set *set, uint32_t chain, double y,
                       cs_boundary_walk *walk) {
  walk->chain = chain;
  walk->piece = find_piece(set, &set->chains[chain], y);
  begin_group(set, walk, find_group(set, &set->pieces[walk->piece], y), true);
  copy_segment(walk);
  while (walk->y1 <= y && cs_boundary_next(set, walk)) {
  }
}
