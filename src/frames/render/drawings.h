/* Exposures that are drawn from maps: which they are, and their drawings in their places.
 *
 *   cel --objects, and a power of two at or above its scale--> map, kept (engine/map/keep.h)
 *   cel --viewport, camera, frame size, lights, opacity------> sheet: the map in its place
 *
 * The rule. An exposure of a frame that repeats is drawn from maps where its antialiasing is
 * "area", no side of the frame is above CS_DRAWINGS_SIDE pixels, it has at most CS_MAP_DRAWINGS
 * cels, and each of these
 *   - has paints that dim all channels alike, pictures that may be read on any thread, and
 *     neither modes, procedures nor rostrums,
 *   - is neither defocused nor blended, and has no light with a shape,
 *   - lies before the horizon, as a whole,
 *   - is small enough to be a map (engine/map/map.h) and, if it is turned, to be turned (turn.h
 *     there), and does not have too many dashes,
 * and if they have at least CS_DRAWINGS_SHAPES shapes each, on average, where the mesh of a bent
 * picture or gradient is one, because it is another mesh in each frame. Of fewer shapes most can be
 * seen: to sweep them takes less time than to draw their maps, the more so the more cels there are.
 *
 * Invariant: this depends on the exposure and the size of the whole frame alone; not on the crop,
 * on the workers, or on which maps are kept.
 */
#pragma once

#include "engine/map/sheets.h"
#include "frames/render/compile.h"

#define CS_DRAWINGS_SIDE 8192
#define CS_DRAWINGS_SHAPES 256

/* *out: is zero, and stays so where the exposure is not drawn from maps; to be finished after an
 * error, too. Errors: as of cs_compile. */
CELSPAN_CHECKED celspan_status cs_drawings_create(celspan_context *context,
                                                  const celspan_rostrum *rostrum,
                                                  const cs_view *view,
                                                  const cs_antialias *antialias, cs_map_frame *out);
void cs_drawings_finish(cs_map_frame *frame, cs_memory *memory);

static inline bool cs_drawings_are_used(const cs_map_frame *frame) { return frame->width > 0; }
