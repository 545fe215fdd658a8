/* The self-check of the active boundaries: see the invariants in engine/sweep/active.h. It is
 * written without the code that keeps the order, so that the two can disagree. */
#include "engine/sweep/active.h"

/* Scenes with more chains than this are not searched for chains that are missing. */
#define FEW_CHAINS 4096

static const cs_boundary_walk *walk_of(const cs_active *active, size_t i) {
  return &active->walks[active->slot[i]];
}

static double slope_of(const cs_active *active, size_t i) {
  return active->segments.slope[i] +
         2 * active->segments.curve[i] * (active->y - active->segments.y0[i]);
}

/* Whether boundary i + 1 may follow boundary i: by x, then by slope, then by chain. */
static bool is_followed(const cs_active *active, size_t i) {
  double slope = slope_of(active, i), next_slope = slope_of(active, i + 1);
  if (active->x[i] != active->x[i + 1])
    return active->x[i] < active->x[i + 1];
  if (slope != next_slope)
    return slope < next_slope;
  return walk_of(active, i)->chain < walk_of(active, i + 1)->chain;
}

/* Whether the current height crosses a chain, and the cull keeps the chain there. */
static bool belongs(const cs_active *active, uint32_t chain) {
  const cs_boundary_chain *c = &active->set->chains[chain];
  return c->y0 <= active->y && active->y < c->y1 &&
         cs_cull_keeps(active->cull, chain, active->tile_row);
}

static bool is_in_place(const cs_active *active, size_t i) {
  const cs_boundary_walk *walk = walk_of(active, i);
  const cs_boundary_chain *chain = &active->set->chains[walk->chain];
  return belongs(active, walk->chain) && active->crossing[i].layer == chain->layer &&
         active->x[i] == cs_boundary_x(walk, active->y);
}

static bool is_complete(const cs_active *active) {
  size_t count = 0;
  for (uint32_t chain = 0; chain < active->set->chain_count; chain++)
    count += belongs(active, chain);
  return count == active->count;
}

bool cs_active_is_ordered(const cs_active *active) {
  if (active->y != active->y_next)
    return true; /* between two heights, x belongs to one of them, and the slope to the other */
  for (size_t i = 0; i < active->count; i++)
    if (!is_in_place(active, i) || (i + 1 < active->count && !is_followed(active, i)))
      return false;
  if (active->next < active->set->chain_count &&
      active->set->chains[active->next].y0 < active->calm_until)
    return false;
  return active->set->chain_count > FEW_CHAINS || is_complete(active);
}
