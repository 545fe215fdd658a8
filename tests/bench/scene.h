/* Drawings as scenes of celspan. */
#pragma once

#include "celspan/celspan.h"
#include "drawing.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ends the program with the context's sentence unless the status is OK. */
void bench_check(celspan_context *context, celspan_status status);

/* One cel over white, which fills a film of 1 x 1. new
 * desc  the cel's properties except its objects; may be NULL */
celspan_rostrum *bench_scene(celspan_context *context, const bench_drawing *drawing,
                             const celspan_cel_desc *desc);
/* A drawing as a cel. new
 * desc  the cel's properties except its objects; may be NULL */
celspan_cel *bench_cel(celspan_context *context, const bench_drawing *drawing,
                       const celspan_cel_desc *desc);
/* A rostrum of these cels, the nearest last; is_backed: over white. new */
celspan_rostrum *bench_rostrum(celspan_context *context, celspan_cel *const *cels, size_t count,
                               bool is_backed);
/* A rostrum of one cel, as described. new */
celspan_rostrum *bench_rostrum_of(celspan_context *context, const celspan_cel_desc *desc,
                                  bool is_backed);
/* All of a drawing as one object. new */
celspan_object *bench_union(celspan_context *context, const bench_drawing *drawing);

/* How the context's frames with the antialiasing "area" are drawn: first, as users get the first
 * frame of a film; again, a later one, whose maps are kept; mapped and mapped-again, the same from
 * maps of all that suits, whatever the rule says; swept, without maps; or else, a user's still. */
void bench_choose_way(celspan_context *context, celspan_frame_desc *desc, const char *way);
/* One exposure of a film of 1 x 1 by one worker. The pointers are borrowed. */
celspan_frame_desc bench_frame(const celspan_exposure *exposure, int width, int height,
                               const celspan_antialias_mode *mode);

#ifdef __cplusplus
}
#endif
