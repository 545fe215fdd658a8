#include "geometry/boundary.h"

#include <math.h>
#include <string.h>

#include "geometry/polyline.h"

void cs_boundary_init(cs_boundary_set *set) { memset(set, 0, sizeof *set); }

void cs_boundary_finish(cs_boundary_set *set, cs_memory *memory) {
  cs_mem_free(memory, set->points, set->point_capacity * sizeof *set->points);
  cs_mem_free(memory, set->pieces, set->piece_capacity * sizeof *set->pieces);
  cs_mem_free(memory, set->chains, set->chain_capacity * sizeof *set->chains);
  cs_boundary_init(set);
}

/* ---------------------------------------------------------------- order */

/* Never false both ways: a chain's first piece is its own, and rises with the place of origin. */
static bool is_before(const cs_boundary_chain *a, const cs_boundary_chain *b) {
  if (a->y0 != b->y0)
    return a->y0 < b->y0;
  if (a->x0 != b->x0)
    return a->x0 < b->x0;
  return a->leaf != b->leaf ? a->leaf < b->leaf : a->piece < b->piece;
}

static void sift_down(cs_boundary_chain *chains, size_t root, size_t count) {
  cs_boundary_chain moved = chains[root];
  for (size_t child; (child = 2 * root + 1) < count; root = child) {
    if (child + 1 < count && is_before(&chains[child], &chains[child + 1]))
      child++;
    if (!is_before(&moved, &chains[child]))
      break;
    chains[root] = chains[child];
  }
  chains[root] = moved;
}

/* A heap sort: in place, without memory of its own, n log n always. */
void cs_boundary_sort(cs_boundary_set *set) {
  cs_boundary_chain *chains = set->chains;
  for (size_t i = set->chain_count / 2; i-- > 0;)
    sift_down(chains, i, set->chain_count);
  for (size_t i = set->chain_count; i-- > 1;) {
    cs_boundary_chain largest = chains[0];
    chains[0] = chains[i];
    chains[i] = largest;
    sift_down(chains, 0, i);
  }
}

/* ---------------------------------------------------------------- walks */

/* Ends the walk's segment at the vertex after its beginning. */
static inline void set_end(const cs_boundary_set *set, cs_boundary_walk *walk) {
  if (walk->ahead == walk->ahead_count) {
    const cs_boundary_piece *piece = &set->pieces[walk->piece];
    uint32_t left = piece->segments - walk->segment;
    walk->ahead = 0;
    walk->ahead_count = left < CS_BOUNDARY_AHEAD ? left : CS_BOUNDARY_AHEAD;
    cs_polyline_feet(set, piece, walk->segment, walk->ahead_count,
                     (celspan_point){walk->x0, walk->y0}, &walk->feet);
  }
  walk->x1 = walk->feet.x[walk->ahead];
  walk->y1 = walk->feet.y[walk->ahead];
  walk->slope = walk->feet.slope[walk->ahead++];
}

bool cs_boundary_next(const cs_boundary_set *set, cs_boundary_walk *walk) {
  const cs_boundary_chain *chain = &set->chains[walk->chain];
  if (walk->segment + 1 < set->pieces[walk->piece].segments)
    walk->segment++;
  else if (walk->piece + 1 < chain->piece + chain->piece_count) {
    walk->piece++;
    walk->segment = 0;
  } else
    return false;
  walk->x0 = walk->x1;
  walk->y0 = walk->y1;
  set_end(set, walk);
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

/* A segment of the piece at or before the first that ends below y: every vertex up to its beginning
 * is above y however it was displaced. */
static uint32_t find_segment(const cs_boundary_set *set, const cs_boundary_piece *piece, double y) {
  double rounding = 1e-10 * (1 + fabs(piece->y0) + fabs(piece->y1));
  double safe = y - CS_POLYLINE_LIFT * piece->sag - 0.5 - rounding; /* 0.5: to a whole height */
  uint32_t low = 1, high = piece->segments;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (cs_polyline_plain(set, piece, middle).y > safe)
      high = middle;
    else
      low = middle + 1;
  }
  return low - 1;
}

void cs_boundary_start(const cs_boundary_set *set, uint32_t chain, double y,
                       cs_boundary_walk *walk) {
  walk->chain = chain;
  walk->piece = find_piece(set, &set->chains[chain], y);
  const cs_boundary_piece *piece = &set->pieces[walk->piece];
  uint32_t segment = find_segment(set, piece, y);
  walk->segment = segment > 0 ? segment - 1 : 0; /* left at once: its foot alone is right */
  walk->ahead = walk->ahead_count = 0;
  walk->x0 = piece->x0;
  walk->y0 = piece->y0;
  set_end(set, walk);
  if (segment > 0)
    cs_boundary_next(set, walk);
  while (walk->y1 <= y && cs_boundary_next(set, walk)) {
  }
}
