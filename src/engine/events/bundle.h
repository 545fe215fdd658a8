/* Bundles: upright courses that replace culled chains (engine/sweep/cull.h).
 *
 *        row of tiles  +-------+-------+-------+
 *                      |       |b    d |       |   the windings of all chains that are culled in
 *                      |  dead |b  dead|       |   this row and whose first dead tile is this one
 *                      |       |b      |       |   change together at its left edge, which nobody
 *                      +-------+-------+-------+   can see
 *
 * A tile is dead for a chain if all of the tile lies behind layers that let nothing through. The
 * courses of bundles come after those of the chains. Without a cull there are none.
 */
#pragma once

#include "engine/events/course.h"
#include "engine/events/windings.h"
#include "engine/sweep/cull.h"

typedef struct cs_bundle {
  uint32_t first, count;   /* of the cull's deferred changes */
  cs_windings_hash change; /* of all of them */
} cs_bundle;

typedef struct cs_bundles {
  cs_bundle *bundles;
  uint32_t *starts; /* of all these changes together */
  size_t count, capacity, row_count;
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
