/* Outlines of strokes that a frame shows whole, kept from frame to frame.
 *
 *   frame 1, pan 10 px   --acquire (stroke, scale and turn)--> made ---\
 *   frame 2, pan 20 px   --acquire (stroke, scale and turn)--> found ---+--> one outline
 *
 * A context has one such cache, which all its threads and frames share, of an eighth of the memory
 * for maps; without memory for maps nothing is kept. The invariants of base/cache.h hold.
 *
 * INVARIANT: an outline depends on the stroke and on the matrix without its translation alone, also
 * where nothing is kept, and for every part of the frame that is asked for.
 */
#pragma once

#include "base/cache.h"
#include "model/stroke/stroke.h"

typedef struct cs_stroke_kept {
  cs_cache_entry entry;
  cs_outline outline;
} cs_stroke_kept;

/* Whether an outline is made and kept whole: the frame has no perspective and shows the stroke
 * whole. It has few pieces and dashes, because whoever asks for a few rows gets all of them. */
bool cs_stroke_kept_suits(const cs_stroke *stroke, const cs_stroke_view *view);
/* Finds the outline of such a stroke, or makes it. Any thread. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_stroke_kept_acquire(celspan_context *context,
                                                      const cs_stroke *stroke,
                                                      const cs_stroke_view *view,
                                                      cs_stroke_kept **out);
void cs_stroke_kept_release(celspan_context *context, cs_stroke_kept *kept);
cs_cache_counts cs_stroke_kept_count(celspan_context *context);
