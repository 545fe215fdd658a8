/* The self-check of the cells of a row: the composer's set, and the set of every cell, against a
 * walk from the left end of the row that remembers nothing. See the invariants in
 * engine/compose/cells.h and engine/compose/composer.h. */
#include <stdlib.h>

#include "engine/compose/cells.h"

/* A walk along the row: the winding number of every layer, and the hash of the layers present. */
typedef struct replay {
  const cs_composer *composer;
  int32_t *windings;
  cs_set_hash hash;
} replay;

static void cross(replay *r, uint32_t layer, int32_t direction) {
  const cs_layer_rule *rule = &r->composer->stack->rules[layer];
  bool was_inside = (r->windings[layer] & rule->winding_mask) != 0;
  r->windings[layer] += direction;
  if (was_inside != ((r->windings[layer] & rule->winding_mask) != 0)) {
    r->hash.a ^= rule->key[0];
    r->hash.b ^= rule->key[1];
  }
}

/* Whether the composer, which has crossed the first `place` boundaries and some of the deferred
 * winding changes, is in the same state as a walk across only these. */
static bool composer_agrees(const cs_cells *cells, replay *r) {
  for (const cs_deferred *d = cells->deferred.first; d < cells->deferred.next; d++)
    cross(r, d->layer, d->direction);
  for (size_t i = 0; i < cells->place; i++)
    cross(r, cells->crossing[i].layer, cells->crossing[i].direction);
  for (size_t layer = 0; layer < r->composer->stack->layer_count; layer++)
    if (r->windings[layer] != r->composer->presences[layer].winding)
      return false;
  return cs_set_hash_same(r->hash, r->composer->hash);
}

/* Whether every cell has the set that is present there, and no layer is present at the right
 * end. */
static bool cells_agree(const cs_cells *cells, const cs_active *active, replay *r) {
  bool agrees = cs_set_hash_same(cells->cells[0].hash, r->hash);
  for (size_t i = 0; agrees && i < active->count; i++) {
    cross(r, active->crossing[i].layer, active->crossing[i].direction);
    agrees = cs_set_hash_same(cells->cells[i + 1].hash, r->hash) ||
             cs_set_hash_same(cells->cells[i + 1].hash, cs_cells_unmade);
  }
  return agrees && cs_set_hash_same(r->hash, (cs_set_hash){0, 0});
}

bool cs_cells_are_true(const cs_cells *cells, const cs_composer *composer,
                       const cs_active *active) {
  /* Memory of the C library, because the memory of the core is counted, and a check must not change
   * this count. */
  size_t count = composer->stack->layer_count;
  replay walk = {.composer = composer, .windings = calloc(count + 1, sizeof(int32_t))};
  if (!walk.windings)
    return true;
  bool agrees = composer_agrees(cells, &walk);
  /* Deferred winding changes take effect where they cannot be seen, a little earlier or later from
   * row to row. So the sets of all cells are exact only if there are no such changes. */
  if (agrees && cells->known == active->count + 1 && cells->deferred.first == cells->deferred.end) {
    memset(walk.windings, 0, count * sizeof *walk.windings);
    walk.hash = (cs_set_hash){0, 0};
    agrees = cells_agree(cells, active, &walk);
  }
  free(walk.windings);
  return agrees;
}
