/* The straight pieces of an active boundary between the current height and the height advanced to.
 *
 *        x[i]      y          current height
 *          \
 *           \  piece          above = (x[i], y), below = the first vertex
 *            v
 *           /  piece
 *          v                  vertices of its bend
 *           \  piece
 *         x_next[i] y_next    height advanced to
 *
 *   for (cs_pieces p = cs_pieces_of(active, i, bend); cs_pieces_next(&p);)
 *     ... p.above, p.below ...
 */
#pragma once

#include "engine/sweep/active.h"

typedef struct cs_pieces {
  celspan_point above, below; /* ends of the current piece */
  celspan_point foot;
  const celspan_point *vertex; /* where the next piece ends, unless it is the last one */
  uint32_t rest;               /* pieces that follow */
} cs_pieces;

/* bend: the bend of boundary i; NULL if it has none. */
static inline cs_pieces cs_pieces_of(const cs_active *active, size_t i, const cs_bend *bend) {
  return (cs_pieces){.below = {active->x[i], active->y},
                     .foot = {active->x_next[i], active->y_next},
                     .vertex = bend ? &active->vertices[bend->vertex] : NULL,
                     .rest = bend ? bend->vertex_count + 1 : 1};
}

static inline bool cs_pieces_next(cs_pieces *pieces) {
  if (pieces->rest == 0)
    return false;
  pieces->above = pieces->below;
  pieces->below = --pieces->rest > 0 ? *pieces->vertex++ : pieces->foot;
  return true;
}
