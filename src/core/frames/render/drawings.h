/* Exposures that are drawn from maps: their drawings in their places, and the cels among them that
 * are swept.
 *
 *   cel --objects, and a power of two at or above its scale--> map, kept (engine/map/keep.h)
 *   cel --viewport, camera, frame size, lights, opacity------> sheet: the map in its place
 *   neighbouring cels that are swept --compile.h-------------> sheet: a plan
 *
 * Which way a cel goes is the rule of ways.h. Where it turns out that a cel cannot be a map, its
 * way is chosen again, and where swept cels have too many dashes the exposure has no sheets.
 *
 * Invariant: this depends on the exposures and the size of the whole frame alone.
 */
#pragma once

#include "engine/map/frame_rows.h"
#include "frames/render/compile.h"

/* other: the rostrum of another exposure, or NULL. repeats: see celspan_frame_desc. *out: all zero,
 * also after the call if the exposure is not drawn from maps; must be finished after an error, too.
 * Errors: as of cs_compile. */
CELSPAN_CHECKED celspan_status cs_drawings_create(celspan_context *context,
                                                  const celspan_rostrum *rostrum,
                                                  const celspan_rostrum *other, const cs_view *view,
                                                  const cs_antialias *antialias, bool repeats,
                                                  cs_map_frame *out);
void cs_drawings_finish(cs_map_frame *frame, cs_memory *memory);

static inline bool cs_drawings_are_used(const cs_map_frame *frame) { return frame->width > 0; }
/* Whether all rows are drawn from the maps. If not, the other rows are swept, as if there were no
 * maps. */
static inline bool cs_drawings_are_enough(const cs_map_frame *frame) {
  return cs_drawings_are_used(frame) && !frame->has_gaps;
}
static inline bool cs_drawings_have(const cs_map_frame *frame, int32_t row) {
  return cs_drawings_are_used(frame) && (!frame->has_gaps || cs_map_frame_has(frame, row));
}
