/* Bundles: upright courses that replace culled chains (engine/sweep/cull.h).
 *
 *        row of tiles  +-------+-------+-------+
 *                      |       |b    d |       |   the windings of all chains that are culled in
 *                      |  dead |b  dead|       |   this row and whose first dead tile is this one
 *                      |       |b      |       |   change together at its left edge, which nobody
 *                      +-------+-------+-------+   can see
 *
 * A tile is dead for a chain if all of the tile lies behind layers that let nothing through. The
 * courses of bundles come after the courses of chains. Without a cull there are none.
 */
#pragma once

#include "base/arrays.h"
#include "engine/events/course.h"
#include "engine/sweep/cull.h"

/* ---- windings.c */

typedef struct cs_windings_hash {
  uint64_t a, b;
} cs_windings_hash;

typedef struct cs_windings_entry {
  cs_windings_hash hash;
  uint32_t parent, boundary; /* the winding that this one comes from, and the boundary crossed; 0
                                has none */
  int32_t zone;              /* for the caller: the zone in which they were met last; 0: none */
} cs_windings_entry;

typedef struct cs_windings {
  CS_ARRAY(cs_windings_entry, entries); /* 0: nothing winds around the place */
  CS_ARRAY(uint32_t, slots);            /* numbers plus 1; 0: free. A power of two */
  size_t count;
} cs_windings;

/* Errors: NO_MEMORY; cs_windings_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_windings_init(celspan_context *context, cs_windings *windings);
void cs_windings_finish(cs_windings *windings, cs_memory *memory);
/* A hash, changed by crossing a boundary of a layer. */
cs_windings_hash cs_windings_add(cs_windings_hash hash, uint32_t layer, int32_t direction);
/* The number of the windings right of a boundary that changes the hash by `change`. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_windings_cross(celspan_context *context, cs_windings *windings,
                                                 uint32_t from, uint32_t boundary,
                                                 cs_windings_hash change, uint32_t *out);

/* ---- bundle.c */

typedef struct cs_bundle {
  uint32_t first, count;   /* the cull's deferred changes */
  cs_windings_hash change; /* the change of all these changes together */
} cs_bundle;

typedef struct cs_bundles {
  CS_ARRAY(cs_bundle, bundles);
  /* by row of tiles, and the end of the last one; NULL: there are no rows */
  CS_ARRAY(uint32_t, starts);
  size_t count;
} cs_bundles;

/* Appends the courses of the bundles, for which there is room. Errors: NO_MEMORY; cs_bundles_finish
 * must be called then, too. */
CELSPAN_CHECKED celspan_status cs_bundles_make(celspan_context *context, const cs_cull *cull,
                                               cs_courses *courses, cs_bundles *out);
void cs_bundles_finish(cs_bundles *bundles, cs_memory *memory);

/* The top of a row of tiles, in units. */
static inline int32_t cs_bundle_top(const cs_cull *cull, int32_t row) {
  return row * cull->tile_height * CS_COURSE_UNIT;
}
